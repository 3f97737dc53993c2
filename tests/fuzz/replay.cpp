// Feeds the fuzz target with files, or with the files of folders: the seeds in every run of the tests, an
// input that libFuzzer kept when it is looked into. Needs no fuzzing compiler.  replay <file or folder> ...

#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

std::size_t replay(const std::filesystem::path& path)
{
    std::ifstream stream(path, std::ios::binary);
    const std::string text(std::istreambuf_iterator<char>(stream), {});
    if (!stream || text.empty()) {
        throw std::runtime_error(path.string() + " cannot be read, or is empty");
    }
    std::printf("%s\n", path.filename().c_str());
    std::fflush(stdout); // the last name is that of an input that ends the program
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
    return 1;
}

} // namespace

int main(int argc, char** argv)
try {
    std::size_t inputs = 0;
    for (int i = 1; i < argc; ++i) {
        const std::filesystem::path path(argv[i]);
        if (!std::filesystem::is_directory(path)) {
            inputs += replay(path);
            continue;
        }
        for (const auto& file : std::filesystem::directory_iterator(path)) {
            inputs += replay(file.path());
        }
    }
    std::printf("%zu inputs replayed\n", inputs);
    return inputs > 0 ? 0 : 1;
} catch (const std::exception& error) {
    std::fprintf(stderr, "replay: %s\n", error.what());
    return 1;
}
