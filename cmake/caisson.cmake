# Flags and short-hands shared by all targets of the project.

add_library(caissonFlags INTERFACE)
target_include_directories(caissonFlags INTERFACE ${PROJECT_SOURCE_DIR}/libsrc)
target_compile_options(caissonFlags INTERFACE
    -Wall -Wextra -Wpedantic -Wshadow -Werror
    # Errors of libm are not read and floating-point traps are not used; rounding stays as written.
    -fno-math-errno -fno-trapping-math)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # Known false alarms of g++ 12 inside its own standard library.
    target_compile_options(caissonFlags INTERFACE -Wno-restrict -Wno-maybe-uninitialized)
endif()
if(CAISSON_NATIVE)
    target_compile_options(caissonFlags INTERFACE -march=native)
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    # What computes is built twice, for every processor and for those with AVX2 (x86-64-v3): see KERNEL and DISPATCHED.
    # Eigen would allocate by the alignment of each: 32 byte, that of AVX2, for both, since one frees what the other took.
    target_compile_definitions(caissonFlags INTERFACE EIGEN_MAX_ALIGN_BYTES=32 EIGEN_MAX_STATIC_ALIGN_BYTES=16)
    target_compile_options(caissonFlags INTERFACE
        -march=$<IF:$<BOOL:$<TARGET_PROPERTY:CAISSON_AVX2>>,x86-64-v3,x86-64-v2>)
    if(NOT CAISSON_SANITIZE)
        set(CAISSON_DISPATCH ON)
        set(CMAKE_POSITION_INDEPENDENT_CODE ON)
        target_compile_options(caissonFlags INTERFACE -fno-semantic-interposition)
        set(CMAKE_BUILD_RPATH_USE_ORIGIN ON)
    endif()
endif()
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")
if(CAISSON_SANITIZE)
    target_compile_options(caissonFlags INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
    target_link_options(caissonFlags INTERFACE -fsanitize=address,undefined)
endif()

# caisson_library(name [KERNEL] DEPENDS other libraries): every .cpp of the folder, public headers beside them. A KERNEL
# has a second build, <name>Avx2.
function(caisson_library name)
    cmake_parse_arguments(ARG "KERNEL" "" "DEPENDS" ${ARGN})
    file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
    if(sources)
        add_library(${name} STATIC ${sources})
        target_link_libraries(${name} PUBLIC caissonFlags ${ARG_DEPENDS})
    else()
        add_library(${name} INTERFACE)
        target_link_libraries(${name} INTERFACE caissonFlags ${ARG_DEPENDS})
    endif()
    if(ARG_KERNEL AND CAISSON_DISPATCH)
        add_library(${name}Avx2 STATIC ${sources})
        target_link_libraries(${name}Avx2 PUBLIC caissonFlags ${ARG_DEPENDS})
        set_target_properties(${name}Avx2 PROPERTIES CAISSON_AVX2 ON)
    endif()
endfunction()

# caisson_application(name [KERNELS libraries] DEPENDS libraries): one executable from the .cpp files of the folder. With
# KERNELS all of it is in a library of its own, built for every processor and, in lib/glibc-hwcaps/x86-64-v3 and with the
# second build of those kernels, for AVX2; the loader of the C library takes the one that the processor is able to run.
function(caisson_application name)
    cmake_parse_arguments(ARG "" "" "KERNELS;DEPENDS" ${ARGN})
    file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
    if(NOT ARG_KERNELS OR NOT CAISSON_DISPATCH)
        add_executable(${name} ${sources})
        target_link_libraries(${name} PRIVATE caissonFlags ${ARG_KERNELS} ${ARG_DEPENDS})
        return()
    endif()
    set(library ${name}Program)
    add_library(${library} SHARED ${sources})
    target_link_libraries(${library} PRIVATE caissonFlags ${ARG_KERNELS} ${ARG_DEPENDS})
    set_target_properties(${library} PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib)
    list(TRANSFORM ARG_KERNELS APPEND Avx2)
    add_library(${library}Avx2 SHARED ${sources})
    target_link_libraries(${library}Avx2 PRIVATE caissonFlags ${ARG_KERNELS} ${ARG_DEPENDS}) # these come first, and count
    set_target_properties(${library}Avx2 PROPERTIES CAISSON_AVX2 ON OUTPUT_NAME ${library}
        LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib/glibc-hwcaps/x86-64-v3)
    file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/mainIsInTheLibrary.cpp CONTENT "")
    add_executable(${name} ${CMAKE_CURRENT_BINARY_DIR}/mainIsInTheLibrary.cpp)
    target_link_libraries(${name} PRIVATE ${library})
    add_dependencies(${name} ${library}Avx2)
endfunction()
