#include "case/Program.h"

#include "case/Log.h"
#include "dictionary/InputProblems.h"

#include <iostream>

namespace caisson {

int runProgram(Program program, int argc, char* argv[])
{
    namespace options = boost::program_options;
    using namespace options::command_line_style;
    try {
        program.options.add_options()("help", "print this and exit")("version", "print the version and exit");
        options::variables_map given;
        options::store(options::command_line_parser(argc, argv)
                           .options(program.options)
                           .style((unix_style | allow_long_disguise) & ~allow_guessing)
                           .positional({})
                           .run(),
                       given);
        if (given.contains("help")) {
            std::cout << "Usage: " << program.name << ' ' << program.arguments << "\n\n"
                      << program.description << "\n\n"
                      << program.options;
            return 0;
        }
        if (given.contains("version")) {
            std::cout << program.name << ' ' << buildVersion() << '\n';
            return 0;
        }
        std::string commandLine = program.name;
        for (int i = 1; i < argc; ++i) {
            commandLine += std::string(" ") + argv[i];
        }
        return program.run(given, commandLine);
    } catch (const InputError& error) {
        std::cerr << error.what() << std::flush;
    } catch (const options::error& error) {
        std::cerr << "--> CAISSONFOAM FATAL ERROR : " << error.what() << "\n    see " << program.name
                  << " -help\n";
    } catch (const std::exception& error) {
        std::cerr << "--> CAISSONFOAM FATAL ERROR : " << error.what() << '\n';
    }
    return 1;
}

} // namespace caisson
