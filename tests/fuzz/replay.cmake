# The seeds of the fuzz target, read in every run of the tests: whatever compiler, no fuzzing.
add_executable(fuzzReplay ${PROJECT_SOURCE_DIR}/tests/fuzz/replay.cpp
                          ${PROJECT_SOURCE_DIR}/tests/fuzz/dictionaryFuzz.cpp)
target_link_libraries(fuzzReplay PRIVATE caissonFlags function1)
add_test(NAME fuzz.seeds COMMAND fuzzReplay ${PROJECT_SOURCE_DIR}/tests/fuzz/seeds)
