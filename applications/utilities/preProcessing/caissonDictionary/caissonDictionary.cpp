// Prints a dictionary with its macros and directives expanded, as `foamDictionary -expand` does.

#include "dictionary/Dictionary.h"

#include <iostream>

int main(int argc, char* argv[])
{
    const std::string_view option = argc > 1 ? argv[1] : "";
    if (argc != 2 || option == "-help" || option == "--help") {
        std::cout << "Usage: caissonDictionary FILE\n"
                     "Prints the dictionary FILE with its macros and directives expanded.\n";
        return argc == 2 ? 0 : 1;
    }
    try {
        const std::filesystem::path file(argv[1]);
        std::cout << caisson::readDictionary(file, std::filesystem::current_path()).print();
    } catch (const caisson::InputError& error) {
        std::cerr << error.what();
        return 1;
    }
    return 0;
}
