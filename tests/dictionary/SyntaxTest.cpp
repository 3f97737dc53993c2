#include "DictionaryTestSupport.h"

#include <chrono>
#include <zlib.h>

namespace caisson {

TEST(Syntax, commentsStringsAndWordsAreRead)
{
    EXPECT_EQ(expanded("a 1; // x ; {\n/* } */ b \"two words\"; c div(phi,U); d plane-0.25; e x:y;"),
              "a 1; b \"two words\"; c div(phi,U); d plane-0.25; e x:y;");
    EXPECT_EQ(expanded("div(phi,U) Gauss linear; grad(p) a(b(c)d);"),
              "div(phi,U) Gauss linear; grad(p) a(b(c)d);");
    EXPECT_EQ(expanded("a \"with \\\"quotes\\\"\";"), "a \"with \\\"quotes\\\"\";");
    EXPECT_EQ(expanded("a #{ verbatim { } \" #};"), "a #{ verbatim { } \" #};");
}

TEST(Syntax, numbersKeepEveryDigit)
{
    const Dictionary dictionary =
        parseDictionary("a 0.1; b -1.7976931348623157e308; c 5e-324; d +3; e .5; f 5.;");
    const auto number = [&](const char* key) { return dictionary.find(key)->tokens.at(0).number; };
    EXPECT_EQ(number("a"), 0.1);
    EXPECT_EQ(number("b"), -1.7976931348623157e308);
    EXPECT_EQ(number("c"), 5e-324);
    EXPECT_EQ(number("d"), 3);
    EXPECT_EQ(number("e"), 0.5);
    EXPECT_EQ(number("f"), 5);
    EXPECT_TRUE(dictionary.find("d")->tokens[0].isInteger);
    EXPECT_FALSE(dictionary.find("f")->tokens[0].isInteger);
}

TEST(Syntax, listsAndDimensionSetsAreRead)
{
    EXPECT_EQ(expanded("a 3(1 2 3); b 5{0}; c ((1 2) (3 4)); d ();"),
              "a 3 ( 1 2 3 ); b 5 { 0 }; c ( ( 1 2 ) ( 3 4 ) ); d ( );");
    EXPECT_EQ(expanded("f nonuniform List<scalar> 2(1 2); g nonuniform List<vector> 1((1 2 3));"),
              "f nonuniform List<scalar> 2 ( 1 2 ); g nonuniform List<vector> 1 ( ( 1 2 3 ) );");
    EXPECT_EQ(expanded("a [0 2 -1 0 0 0 0]; b b [kg m^-3] 1;"), "a [ 0 2 -1 0 0 0 0 ]; b b [ kg m^-3 ] 1;");
}

TEST(Syntax, theLastOfTwoEqualKeysStandsAndDictionariesMerge)
{
    EXPECT_EQ(expanded("a 1; a 2; b { c 1; } b { d 2; } e { f 1; } e 3;"), "a 2; b { c 1; d 2; } e 3;");
}

TEST(Syntax, lookupTakesTheExactKeyThenTheLastPattern)
{
    const Dictionary dictionary =
        parseDictionary("\"a.*\" first; \"ab.*\" second; abc exact; \"(?i)walls\" anyCase;");
    const auto word = [&](const char* key) {
        const Entry* entry = dictionary.find(key);
        return entry ? entry->tokens[0].text : "none";
    };
    EXPECT_EQ(word("abc"), "exact");
    EXPECT_EQ(word("abd"), "second");
    EXPECT_EQ(word("ax"), "first");
    EXPECT_EQ(word("xa"), "none"); // a pattern has to match the whole word
    EXPECT_EQ(word("WALLS"), "anyCase");
}

TEST(Syntax, aPatternWithANewValueComesBeforeTheOthers)
{
    const auto found = [](const std::string& text, const char* key) {
        const Dictionary dictionary = parseDictionary(text);
        const Entry* entry = dictionary.findScoped(key);
        return entry ? entry->tokens.at(0).number : 0;
    };
    EXPECT_EQ(found("\"a.*\" 1; \"ab.*\" 2; \"a.*\" 3;", "abc"), 3);
    EXPECT_EQ(found("\"a.*\" 1; \"ab.*\" 2; p { \"a.*\" 5; } $p;", "abc"), 5);
    EXPECT_EQ(found("p { \"ab.*\" 6; \"a.*\" 5; } q { \"a.*\" 1; \"ab.*\" 2; $..p; }", "q.abc"), 5);
    EXPECT_EQ(found("\"a.*\" 1; \"ab.*\" 2; #inputMode protect\n\"a.*\" 3;", "abc"), 2);
    EXPECT_EQ(found("\"a.*\" { x 1; } \"ab.*\" { x 2; } \"a.*\" { x 3; }", "abc.x"), 2); // merged: as it was
    EXPECT_EQ(found("\"a.*\" { x 1; } \"ab.*\" { x 2; } #overwrite \"a.*\" { x 3; }", "abc.x"), 2);
    EXPECT_EQ(found("\"a.*\" 1; \"ab.*\" { x 2; } \"a.*\" { x 3; }", "abc.x"), 3);
    EXPECT_EQ(found("\"a.*\" 1; \"ab.*\" 2; \"a.*\" 3; b 1; #remove b\n", "abc"), 3);
    EXPECT_EQ(found("\"a.*\" 1; \"ab.*\" 2; \"a.*\" 3; #remove \"a\\.\\*\"\n", "abc"), 2);
}

TEST(Syntax, scopedLookupTakesTheShortestKeyThatLeadsToAnEntry)
{
    const Dictionary dictionary =
        parseDictionary("a { b.c 1; b { c 2; d 3; } e.f 5; } a.b { d 4; g 6; } h 7; h.i 8;");
    const auto number = [&](const char* path) {
        const Entry* entry = dictionary.findScoped(path);
        return entry ? entry->tokens.at(0).number : 0;
    };
    EXPECT_EQ(number("a.b.c"), 2);
    EXPECT_EQ(number("a.b.d"), 3);
    EXPECT_EQ(number("a.e.f"), 5);
    EXPECT_EQ(number("a.b.g"), 6);
    EXPECT_EQ(number("h.i"), 8); // OpenFOAM ends at the value h
    EXPECT_EQ(number("a.b.e"), 0);
    EXPECT_EQ(number("h.j"), 0);
}

TEST(Syntax, aNumberThatRunsOnIsAWord)
{
    const Dictionary dictionary = parseDictionary("a (12-13 5); b 2024-01-01; c 1-; d (1 -2 +3 4e-5 6e+7);");
    const auto kinds = [&](const char* key) {
        std::string text;
        for (const Token& token : dictionary.find(key)->tokens) {
            text += token.kind == Token::Kind::number ? "n" : token.kind == Token::Kind::word ? "w" : ".";
        }
        return text;
    };
    EXPECT_EQ(kinds("a"), ".wn."); // not the two numbers 12 and -13
    EXPECT_EQ(kinds("b"), "w");
    EXPECT_EQ(kinds("c"), "w");
    EXPECT_EQ(kinds("d"), ".nnnnn.");
}

TEST(Syntax, binaryListsKeepTheirBytes)
{
    const double values[] = {1.5, -2.25};
    const std::string raw(reinterpret_cast<const char*>(values), sizeof values);
    const std::string header = "FoamFile { format binary; arch \"LSB;label=32;scalar=64\"; }\n";
    const Dictionary dictionary =
        parseDictionary(header + "field nonuniform List<scalar> 2(" + raw + ");\nafter 1;");
    const std::vector<Token>& tokens = dictionary.find("field")->tokens;
    ASSERT_EQ(tokens.size(), 6U);
    EXPECT_EQ(tokens[4].kind, Token::Kind::binary);
    EXPECT_EQ(tokens[4].text, raw);
    EXPECT_EQ(dictionary.find("after")->tokens[0].number, 1);
}

TEST(Syntax, theHeaderTellsTheSizeOfBinaryNumbers)
{
    const std::string raw("\1\0\0\0\0\0\0\0\2\0\0\0\0\0\0\0", 16);
    const std::string header = "FoamFile { format binary; arch \"LSB;label=64;scalar=64\"; }\n";
    EXPECT_EQ(parseDictionary(header + "a List<label> 2(" + raw + ");").find("a")->tokens[3].text, raw);
    EXPECT_EQ(refusal("FoamFile { format binary; arch \"MSB;label=32;scalar=64\"; }"),
              "file:1: the file's binary numbers have their most significant byte first\n"
              "    convert it on a machine of that kind (foamFormatConvert)\n");
    EXPECT_EQ(refusal(header + "a List<label> 9(" + raw + ");"),
              "file:2: the file ends inside a binary list\n    it was cut short\n");
}

TEST(Syntax, aCompressedFileStandsInForAMissingOne)
{
    const TemporaryDirectory directory;
    const std::filesystem::path file = directory.path() / "transportProperties";
    gzFile stream = gzopen((file.string() + ".gz").c_str(), "wb");
    gzputs(stream, "nu 1e-6;");
    gzclose(stream);
    EXPECT_EQ(readDictionary(file).find("nu")->tokens[0].number, 1e-6);
}

TEST(Syntax, aCompressedFileThatWasCutShortIsRefused)
{
    const TemporaryDirectory directory;
    const std::filesystem::path file = directory.path() / "transportProperties.gz";
    gzFile stream = gzopen(file.c_str(), "wb");
    for (int i = 0; i < 20000; ++i) {
        gzprintf(stream, "key%d %d;\n", i, i * i % 9973);
    }
    gzclose(stream);
    EXPECT_EQ(readDictionary(directory.path() / "transportProperties").entries().size(), 20000U);
    std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
    EXPECT_THROW(static_cast<void>(readDictionary(directory.path() / "transportProperties")), InputError);
}

TEST(Syntax, whatIsWrongIsNamedWithItsLine)
{
    EXPECT_EQ(refusal("a 1;\nb 2"), "file:2: 'b' has no end\n    is a ';' missing?\n");
    EXPECT_EQ(refusal("a\n{\n b 1\n}"), "file:3: 'b' has no end\n    a ';' is missing before the '}'\n");
    EXPECT_EQ(refusal("a { b 1;\n"),
              "file:1: '{' without '}'\n    the dictionary that opens here is not closed\n");
    EXPECT_EQ(refusal("a 1;\n}\n"), "file:2: '}' closes nothing\n    is there one too many?\n");
    EXPECT_EQ(refusal("a (1 2;"), "file:1: 'a' has no end\n    a '(' is not closed\n");
    EXPECT_EQ(refusal("a (1\n2};"), "file:2: '}' closes nothing in the value of 'a'\n"
                                    "    the entry begins on line 1\n");
    EXPECT_EQ(refusal("a \"text\n;"),
              "file:1: string without an end\n    close it with \", or end the line with a backslash\n");
    EXPECT_EQ(refusal("a 1; /* b"), "file:1: comment without an end\n    close it with */\n");
    EXPECT_EQ(refusal("{ a 1; }"), "file:1: '{' where a keyword should stand\n"
                                   "    an entry is   keyword value;   or   keyword { ... }\n");
    EXPECT_EQ(refusal("\n3 ( 1 2 3 )"), "file:2: a list where a keyword should stand\n"
                                        "    is this file a list, not a dictionary?\n");
    EXPECT_EQ(refusal("\"(a\" 1;"), "file:1: \"(a\" is no regular expression: Unmatched ( or \\(\n"
                                    "    a keyword in quotes is a pattern\n");
}

TEST(Syntax, filesOfOtherSystemsAreRead)
{
    const TemporaryDirectory directory;
    const std::filesystem::path file =
        directory.write("file", "\xEF\xBB\xBF"
                                "a 1;\r\n#if 1\r\nb \"x y\";\r\n#endif\r\n#include \"more\"\r\n");
    directory.write("more", "c (1\r\n2);\r\n");
    const Dictionary dictionary = readDictionary(file, directory.path());
    ASSERT_EQ(dictionary.entries().size(), 3U);
    EXPECT_EQ(dictionary.find("a")->tokens.at(0).number, 1);
    EXPECT_EQ(dictionary.find("b")->tokens.at(0).text, "x y");
    EXPECT_EQ(dictionary.find("c")->tokens.size(), 4U);
}

TEST(Syntax, aMissingFileIsNamed)
{
    try {
        readDictionary("/nonexistent/controlDict", {}, "system/controlDict");
        FAIL() << "accepted";
    } catch (const InputError& error) {
        EXPECT_EQ(std::string(error.what()),
                  "--> CAISSONFOAM FATAL ERROR : 1 problem in system/controlDict\n\n"
                  "system/controlDict: cannot be read\n"
                  "    the file is missing or not readable\n");
    }
}

TEST(Syntax, dictionariesInAListAreRead)
{
    const Dictionary dictionary = parseDictionary("regions ( { a 1; } sand { a 2; b { c 3; } } );");
    InputProblems problems;
    const std::vector<Dictionary> list = dictionariesIn(*dictionary.find("regions"), problems);
    ASSERT_EQ(list.size(), 2U);
    EXPECT_EQ(list[1].name(), "sand");
    EXPECT_EQ(list[1].findScoped("b.c")->tokens[0].number, 3);
    EXPECT_TRUE(problems.empty());

    const Dictionary wrong = parseDictionary("regions ( 3 );");
    dictionariesIn(*wrong.find("regions"), problems);
    ASSERT_EQ(problems.all().size(), 1U);
    EXPECT_EQ(problems.all()[0].message, "'regions': '3' is not a dictionary");

    const auto complaint = [](const std::string& text) {
        InputProblems found;
        static_cast<void>(dictionariesIn(*parseDictionary("regions " + text + ";").find("regions"), found));
        return found.empty() ? "" : found.all()[0].message;
    };
    EXPECT_EQ(complaint("2({ a 1; } { a 2; })"), "");
    EXPECT_EQ(complaint("3({ a 1; } { a 2; })"), "'regions': has 2 dictionaries, not 3");
    EXPECT_EQ(complaint("({ a 1; } sand)"), "'regions': 'sand' is not a dictionary");
    EXPECT_EQ(complaint("({ a 1; }) { b 2; }"), "'regions': '{' is not a dictionary");
    EXPECT_EQ(complaint("()"), "");
}

TEST(Syntax, aFieldOfAHundredThousandNumbersIsReadInATenthOfASecond)
{
    std::string text = "internalField nonuniform List<scalar> 100000(";
    for (int i = 0; i < 100000; ++i) {
        text += std::to_string(i * 1.2345678901) + "\n";
    }
    text += ");";
    const auto start = std::chrono::steady_clock::now();
    const Dictionary dictionary = parseDictionary(text);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    EXPECT_EQ(dictionary.find("internalField")->tokens.size(), 100005U);
    EXPECT_LT(seconds, 0.5) << "expected about 0.02 s on an idle machine";
    RecordProperty("seconds", std::to_string(seconds));
}

} // namespace caisson
