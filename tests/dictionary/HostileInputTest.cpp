// Input that was made to hang or to crash a reader: it has to be refused, and soon.

#include "DictionaryTestSupport.h"
#include "dictionary/Expression.h"

#include <chrono>
#include <functional>

namespace caisson {

namespace {

std::string times(int count, const std::string& text)
{
    std::string result;
    for (int i = 0; i < count; ++i) {
        result += text;
    }
    return result;
}

/// The first line of the refusal; fails where it takes more than a second.
std::string refusedSoon(const std::string& text)
{
    const auto start = std::chrono::steady_clock::now();
    const std::string report = refusal(text);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    EXPECT_LT(seconds, 10.0) << "expected well below one second, ten allow for a busy machine";
    return report.substr(0, report.find('\n'));
}

} // namespace

TEST(HostileInput, deepNestingIsRefused)
{
    EXPECT_EQ(refusedSoon(times(100000, "a {")), "file:1: dictionaries are nested too deeply");
    EXPECT_EQ(refusedSoon("a " + times(100000, "(")), "file:1: lists are nested too deeply");
    EXPECT_EQ(refusedSoon(times(100000, "#default ")), "file:1: directives are nested too deeply");
    EXPECT_EQ(refusedSoon("a #eval{" + times(100000, "(") + "};").substr(0, 30),
              "file:1: #eval: nested too deep");
    EXPECT_EQ(refusedSoon("a " + times(100000, "${") + times(100000, "}") + ";"),
              "file:1: macros are nested too deeply");
    EXPECT_EQ(refusedSoon("a " + times(100000, "${b:-") + times(100000, "}") + ";"),
              "file:1: macros are nested too deeply");
    EXPECT_EQ(refusedSoon("\"" + times(100000, "(") + "\" 1;").substr(0, 9), "file:1: \"");
}

TEST(HostileInput, macrosThatDoubleThemselvesAreRefused)
{
    std::string text = "a0 (1 2 3);";
    for (int i = 1; i < 60; ++i) {
        const std::string before = "$a" + std::to_string(i - 1);
        text += "a" + std::to_string(i) + " (" + before + " " + before + ");\n";
    }
    EXPECT_NE(refusedSoon(text).find("macros bring in more than five million values"), std::string::npos);
    EXPECT_EQ(refusedSoon("a { x 1; }" + times(60, " b { c $a; d $a; } a $b;")),
              "file:1: macros bring in more than five million values");
    EXPECT_EQ(refusedSoon(times(20, "a $.; b $.; c $.;")),
              "file:1: macros bring in more than five million values");
    EXPECT_NE(refusedSoon("a x;" + times(60, "a #word \"$a$a\";\n")).find("a million characters"),
              std::string::npos);
}

TEST(HostileInput, dictionariesCopiedIntoThemselvesAreRefused)
{
    EXPECT_EQ(refusedSoon("a { x 1; }" + times(1000, " a { x $:a; }")),
              "file:1: macros bring in more than five million values");
    EXPECT_EQ(refusedSoon(times(150, "a {") + "x 1;" + times(150, "}") + times(100, "b {") + "$:a;"),
              "file:1: dictionaries are nested too deeply");
}

TEST(HostileInput, costlyPatternsAreRefused)
{
    EXPECT_EQ(refusedSoon("\"((a{1,255}){1,255}){1,255}\" 1;"),
              "file:1: \"((a{1,255}){1,255}){1,255}\" is no regular expression: repeats too often");
    EXPECT_EQ(refusedSoon("\"(a*)*\\1\" 1;"),
              "file:1: \"(a*)*\\1\" is no regular expression: back-references are not part of extended "
              "expressions");
    // The C library doubles what stands before each '+'.
    EXPECT_EQ(refusedSoon("\"a" + times(40, "+") + "\" 1;"),
              "file:1: \"a" + times(40, "+") + "\" is no regular expression: repeats too often");
    EXPECT_NE(refusedSoon("\"" + times(20, "(") + "a" + times(20, ")+") + "\" 1;").find("repeats too often"),
              std::string::npos);
    EXPECT_EQ(refusal("\"" + times(50, "a+b") + "([(+]+|[^])+]+|[[:alpha:]+])\" 1;"), "accepted");
}

TEST(HostileInput, manyKeysAreReadInLinearTime)
{
    std::string text;
    for (int i = 0; i < 100000; ++i) {
        text += "k" + std::to_string(i) + " 1;\n";
    }
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(parseDictionary(text).entries().size(), 100000U);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    EXPECT_LT(seconds, 10.0) << "expected about 0.1 s; comparing each with each would take minutes";
}

TEST(HostileInput, controlCharactersAndCutTextDoNotCrash)
{
    for (const char* text : {"a \0",       "$",   "${",   "#",        "#{",      "a #eval",   "a #eval{",
                             "\\",         "a $", "a $[", "#include", "#remove", "#remove (", "#if",
                             "#inputMode", "a [", "\"",   "a b",      "a {",     "#default"}) {
        EXPECT_NE(refusal(text), "accepted") << text;
    }
}

} // namespace caisson
