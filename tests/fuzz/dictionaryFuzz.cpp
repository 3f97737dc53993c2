// Feeds the dictionary reader with whatever libFuzzer invents: it may refuse, it may not crash, hang or touch
// the disk. What it accepts is printed, read again and handed to the readers of keywords and functions.

#include "function1/Function1.h"

#include <cstdint>
#include <cstdlib>

namespace {

constexpr caisson::Keyword table[] = {{"a", "kg/m3", "", "(0, inf)", "a number"},
                                      {"b", "integer", "1", "[0, 9]", "a whole number"},
                                      {"c", "flag", "yes", "", "a flag"},
                                      {"d", "word", "x", "x y z", "a word"},
                                      {"e", "m/s2", "(0 0 -9.81)", "", "a vector"},
                                      {"f", "Function1", "-", "", "a function"},
                                      {"g", "dictionary", "-", "", "a dictionary"},
                                      {"h", "list", "-", "", "dictionaries"},
                                      {"value", "list", "-", "", "numbers, or whatever"}};

void readKeywords(const caisson::Dictionary& dictionary, bool functions)
{
    caisson::InputProblems problems;
    const caisson::KeywordReader reader(dictionary, table, "'fuzz'", problems);
    static_cast<void>(reader.number("a"));
    static_cast<void>(reader.integer("b"));
    static_cast<void>(reader.flag("c"));
    static_cast<void>(reader.word("d"));
    static_cast<void>(reader.words("d"));
    static_cast<void>(reader.vector("e"));
    static_cast<void>(reader.dictionary("g"));
    static_cast<void>(reader.dictionaries("h"));
    static_cast<void>(reader.rows("value"));
    static_cast<void>(dictionary.findScoped("g.a.b.c"));
    if (functions) {
        static_cast<void>(caisson::readFunction1(dictionary, "f", problems)->end());
        static_cast<void>(caisson::readVectorFunction1(dictionary, "e", problems).component[2]->end());
    }
    static_cast<void>(caisson::formatProblems("fuzz", problems.all()));
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string text(reinterpret_cast<const char*>(data), size);
    const bool noFiles = text.find("file") == std::string::npos; // tables of functions may come from files
    try {
        const caisson::Dictionary dictionary = caisson::parseDictionary(text, "fuzz"); // refuses #include
        readKeywords(dictionary, noFiles);
        const std::string printed = dictionary.print();
        if (text.find("#word") == std::string::npos && text.find("binary") == std::string::npos &&
            caisson::parseDictionary(printed, "printed").print() != printed) {
            std::abort(); // what was accepted has to read the same again
        }
    } catch (const caisson::InputError&) {
        return 0;
    }
    return 0;
}
