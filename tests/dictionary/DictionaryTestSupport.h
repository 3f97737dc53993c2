#pragma once

#include "dictionary/Dictionary.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <unistd.h>

namespace caisson {

/// What `text` expands to, on one line, single blanks.
inline std::string expanded(const std::string& text)
{
    std::istringstream words(parseDictionary(text, "file").print());
    std::string line;
    for (std::string word; words >> word;) {
        line += (line.empty() ? "" : " ") + word;
    }
    return line;
}

/// The report with which `text` is refused, without its first line; "accepted" where it is not.
inline std::string refusal(const std::string& text)
{
    try {
        static_cast<void>(parseDictionary(text, "file"));
    } catch (const InputError& error) {
        const std::string report = error.what();
        return report.substr(report.find("\n\n") + 2);
    }
    return "accepted";
}

/// A directory that is gone after the test.
class TemporaryDirectory
{
public:
    TemporaryDirectory()
    {
        std::string name = (std::filesystem::temp_directory_path() / "caissonDictionaryXXXXXX").string();
        path_ = mkdtemp(name.data());
    }
    ~TemporaryDirectory() { std::filesystem::remove_all(path_); }
    TemporaryDirectory(const TemporaryDirectory&) = delete;
    TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;

    std::filesystem::path write(const std::string& name, const std::string& content) const
    {
        const std::filesystem::path file = path_ / name;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file, std::ios::binary) << content;
        return file;
    }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

} // namespace caisson
