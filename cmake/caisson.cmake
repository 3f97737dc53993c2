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
    target_compile_options(caissonFlags INTERFACE -march=x86-64-v2)
endif()
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")
if(CAISSON_SANITIZE)
    target_compile_options(caissonFlags INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
    target_link_options(caissonFlags INTERFACE -fsanitize=address,undefined)
endif()

# caisson_library(name DEPENDS other libraries): every .cpp of the folder, public headers beside them.
function(caisson_library name)
    cmake_parse_arguments(ARG "" "" "DEPENDS" ${ARGN})
    file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
    if(sources)
        add_library(${name} STATIC ${sources})
        target_link_libraries(${name} PUBLIC caissonFlags ${ARG_DEPENDS})
    else()
        add_library(${name} INTERFACE)
        target_link_libraries(${name} INTERFACE caissonFlags ${ARG_DEPENDS})
    endif()
endfunction()

# caisson_application(name DEPENDS libraries): one executable from the .cpp files of the folder.
function(caisson_application name)
    cmake_parse_arguments(ARG "" "" "DEPENDS" ${ARGN})
    file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
    add_executable(${name} ${sources})
    target_link_libraries(${name} PRIVATE caissonFlags ${ARG_DEPENDS})
endfunction()
