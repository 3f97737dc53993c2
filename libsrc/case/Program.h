#pragma once

#include <boost/program_options.hpp>

#include <functional>
#include <string>

namespace caisson {

/// A program as its user sees it: what it takes on its command line, and what it does with that.
struct Program
{
    std::string name;
    std::string arguments;   ///< as in `Usage: name <arguments>`
    std::string description; ///< some lines
    /// Besides -help and -version, which every program has. `-case DIR` and `--case DIR` are alike.
    boost::program_options::options_description options{"Options"};
    /// @param commandLine  as it was given, for the log
    /// @returns the exit status
    std::function<int(const boost::program_options::variables_map& given, const std::string& commandLine)>
        run = {};
};

/// Reads the command line and runs the program; prints what is thrown.
/// @returns the exit status, 1 after an error
int runProgram(Program program, int argc, char* argv[]);

} // namespace caisson
