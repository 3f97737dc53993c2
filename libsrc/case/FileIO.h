#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace caisson {

/// A file that could not be written (disk full, no permission ...): names the file and the system's reason.
/// Not the user's input, so not an InputError.
class WriteError : public std::runtime_error
{
public:
    WriteError(const std::filesystem::path& file, int errorNumber);
};

/// Whether `file` or `file`.gz is there.
bool fileExists(const std::filesystem::path& file);

/// The whole of `file`, or of `file`.gz where `file` is missing.
/// @param displayName  how messages call the file
/// @param hint  what the user can do where it is missing
/// @throws InputError where both are missing or cannot be read
std::string readFile(const std::filesystem::path& file, const std::string& displayName,
                     const std::string& hint = {});

/// Writes `content` under a temporary name and renames it to `file` (`file`.gz where `compressed`), so that a
/// reader never meets half a file. Makes the folders; removes the other of `file` and `file`.gz.
/// @throws WriteError
void writeFileAtomically(const std::filesystem::path& file, std::string_view content,
                         bool compressed = false);

/// Appends `text` to a file in one piece; the file must end up longer by exactly that. @throws WriteError
void appendToFile(const std::filesystem::path& file, std::string_view text);

/// Renames a file or folder. @throws WriteError
void renameOrThrow(const std::filesystem::path& from, const std::filesystem::path& to);

} // namespace caisson
