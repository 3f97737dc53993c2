#include "case/FileIO.h"

#include "dictionary/InputProblems.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <limits>
#include <unistd.h>
#include <zlib.h>

namespace caisson {

namespace fs = std::filesystem;

namespace {

fs::path withGz(const fs::path& file) { return fs::path(file) += ".gz"; }

std::string gunzip(const fs::path& file, const std::string& displayName)
{
    gzFile in = gzopen(file.c_str(), "rb");
    std::string content;
    if (in == nullptr) {
        throw InputError(displayName,
                         {{{displayName, 0}, std::string("cannot be read: ") + std::strerror(errno), {}}});
    }
    gzbuffer(in, 1 << 17);
    std::string block(1 << 17, '\0');
    int got = 0;
    while ((got = gzread(in, block.data(), static_cast<unsigned>(block.size()))) > 0) {
        content.append(block.data(), static_cast<std::size_t>(got));
    }
    // Z_BUF_ERROR at the close is what a file that was cut short ends with.
    const int closed = gzclose(in);
    if (got < 0 || closed != Z_OK) {
        throw InputError(displayName, {{{displayName, 0}, "is not a complete gzip file", {}}});
    }
    return content;
}

/// What gzip makes of `content`.
std::string gzip(std::string_view content)
{
    if (content.size() > std::numeric_limits<uInt>::max()) {
        throw std::runtime_error("files above 4 GiB cannot be compressed: set writeCompression off");
    }
    z_stream stream{};
    // 16 + 15: gzip wrapper, largest window.
    if (deflateInit2(&stream, 6, Z_DEFLATED, 16 + 15, 8, Z_DEFAULT_STRATEGY) != Z_OK) {
        throw std::runtime_error("zlib: deflateInit2 failed");
    }
    std::string packed(deflateBound(&stream, content.size()), '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(content.data()));
    stream.avail_in = static_cast<uInt>(content.size());
    stream.next_out = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_out = static_cast<uInt>(packed.size());
    const int result = deflate(&stream, Z_FINISH);
    packed.resize(stream.total_out);
    deflateEnd(&stream);
    if (result != Z_STREAM_END) {
        throw std::runtime_error("zlib: deflate failed");
    }
    return packed;
}

/// Writes all of `content` and closes; errors of a full disk may show at either.
void writeAll(const fs::path& file, int flags, std::string_view content)
{
    const int descriptor = ::open(file.c_str(), flags | O_CLOEXEC, 0666);
    if (descriptor < 0) {
        throw WriteError(file, errno);
    }
    while (!content.empty()) {
        const ssize_t written = ::write(descriptor, content.data(), content.size());
        if (written < 0 && errno == EINTR) {
            continue;
        }
        if (written < 0) {
            const int error = errno;
            ::close(descriptor);
            throw WriteError(file, error);
        }
        content.remove_prefix(static_cast<std::size_t>(written));
    }
    if (::close(descriptor) != 0) {
        throw WriteError(file, errno);
    }
}

void makeParentFolder(const fs::path& file)
{
    std::error_code error;
    if (file.has_parent_path()) {
        fs::create_directories(file.parent_path(), error);
    }
    if (error) {
        throw WriteError(file.parent_path(), error.value());
    }
}

} // namespace

WriteError::WriteError(const fs::path& file, int errorNumber)
    : std::runtime_error("cannot write " + file.string() + ": " + std::strerror(errorNumber))
{
}

bool fileExists(const fs::path& file)
{
    return fs::is_regular_file(file) || fs::is_regular_file(withGz(file));
}

std::string readFile(const fs::path& file, const std::string& displayName, const std::string& hint)
{
    if (!fs::is_regular_file(file)) {
        if (fs::is_regular_file(withGz(file))) {
            return gunzip(withGz(file), displayName + ".gz");
        }
        throw InputError(displayName, {{{displayName, 0}, "file is missing", hint}});
    }
    std::ifstream in(file, std::ios::binary);
    std::string content;
    content.resize(fs::file_size(file));
    in.read(content.data(), static_cast<std::streamsize>(content.size()));
    if (!in) {
        throw InputError(displayName,
                         {{{displayName, 0}, std::string("cannot be read: ") + std::strerror(errno), {}}});
    }
    return content;
}

void writeFileAtomically(const fs::path& file, std::string_view content, bool compressed)
{
    makeParentFolder(file);
    const fs::path target = compressed ? withGz(file) : file;
    const fs::path temporary = target.parent_path() / ("." + target.filename().string() + ".writing");
    const std::string packed = compressed ? gzip(content) : std::string();
    try {
        writeAll(temporary, O_WRONLY | O_CREAT | O_TRUNC, compressed ? std::string_view(packed) : content);
        renameOrThrow(temporary, target);
    } catch (...) {
        ::unlink(temporary.c_str());
        throw;
    }
    ::unlink((compressed ? file : withGz(file)).c_str());
}

void appendToFile(const fs::path& file, std::string_view text)
{
    makeParentFolder(file);
    writeAll(file, O_WRONLY | O_CREAT | O_APPEND, text);
}

void renameOrThrow(const fs::path& from, const fs::path& to)
{
    if (std::rename(from.c_str(), to.c_str()) != 0) {
        throw WriteError(to, errno);
    }
}

} // namespace caisson
