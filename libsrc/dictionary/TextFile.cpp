#include "dictionary/TextFile.h"

#include <zlib.h>

namespace caisson {

std::optional<std::string> readTextFile(const std::filesystem::path& file)
{
    std::error_code ignored;
    std::filesystem::path path = file;
    if (!std::filesystem::is_regular_file(path, ignored)) {
        path += ".gz";
        if (!std::filesystem::is_regular_file(path, ignored)) {
            return std::nullopt;
        }
    }
    gzFile stream = gzopen(path.c_str(), "rb"); // reads plain files as they are
    if (!stream) {
        return std::nullopt;
    }
    std::string text;
    char buffer[1 << 16];
    int read = 0;
    while ((read = gzread(stream, buffer, sizeof buffer)) > 0) {
        text.append(buffer, read);
    }
    const bool complete = gzclose(stream) == Z_OK; // a compressed file that was cut short ends in silence
    constexpr std::string_view byteOrderMark =
        "\xEF\xBB\xBF"; // of UTF-8, as some editors and spreadsheets write it
    if (text.starts_with(byteOrderMark)) {
        text.erase(0, byteOrderMark.size());
    }
    return read == 0 && complete ? std::optional(std::move(text)) : std::nullopt;
}

} // namespace caisson
