#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace caisson {

/// The whole of a file, or of `file`.gz where `file` is missing; nothing where neither can be read.
std::optional<std::string> readTextFile(const std::filesystem::path& file);

} // namespace caisson
