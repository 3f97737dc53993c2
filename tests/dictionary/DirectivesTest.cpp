#include "DictionaryTestSupport.h"

namespace caisson {

TEST(Directives, conditionsChooseTheirEntries)
{
    EXPECT_EQ(expanded("#if 1\na 1;\n#else\na 2;\n#endif\nb 3;"), "a 1; b 3;");
    EXPECT_EQ(expanded("#if off\na 1;\n#else\na 2;\n#endif"), "a 2;");
    EXPECT_EQ(expanded("x on;\n#if $x\na 1;\n#endif"), "x on; a 1;");
    EXPECT_EQ(expanded("x 3;\n#if #eval{ $x > 2 }\na 1;\n#endif"), "x 3; a 1;");
    EXPECT_EQ(expanded("#if #eval \"1 > 2\"\na 1;\n#endif"), "");
    EXPECT_EQ(expanded("#if 0\n#if 1\na 1;\n#else\nb 1;\n#endif\nc 1;\n#else\nd 1;\n#endif"), "d 1;");
    EXPECT_EQ(expanded("s {\n#if 1\na 1;\n#endif\nb 2; }"), "s { a 1; b 2; }");
}

TEST(Directives, ifeqComparesNumbersWithNumbersAndTextWithText)
{
    const auto chosen = [](const std::string& condition) {
        return expanded("w one;\n#ifeq " + condition + "\nx yes;\n#else\nx no;\n#endif");
    };
    EXPECT_EQ(chosen("1 1.0"), "w one; x yes;");
    EXPECT_EQ(chosen("a \"a\""), "w one; x yes;");
    EXPECT_EQ(chosen("$w one"), "w one; x yes;");
    EXPECT_EQ(chosen("a b"), "w one; x no;");
    EXPECT_EQ(chosen("1 \"1\""), "w one; x no;");
    EXPECT_EQ(chosen("$CAISSON_TEST_UNSET \"\""), "w one; x yes;");
}

TEST(Directives, conditionsThatMakeNoSenseAreRefused)
{
    EXPECT_EQ(refusal("#if nonsense\n#endif"),
              "file:1: 'nonsense' is neither true nor false\n    valid: true false yes no on off\n");
    EXPECT_EQ(refusal("#if 1\na 1;"), "file:2: #if without #endif\n");
    EXPECT_EQ(refusal("a 1;\n#endif"), "file:2: #endif without #if\n");
    EXPECT_EQ(refusal("#ifeq 1\n#endif"), "file:1: #ifeq needs two values\n    got 1\n");
    EXPECT_EQ(refusal("#if 1\n#else\n#else\n#endif"), "file:3: #else twice\n");
    EXPECT_EQ(refusal("#if 0\n#else\na 1;\n#else\n#endif"), "file:4: #else twice\n");
    EXPECT_EQ(refusal("#if 0.5\n#endif"),
              "file:1: '0.5' is neither true nor false\n    valid: true false yes no on off\n");
}

TEST(Directives, inputModesDecideAboutEqualKeys)
{
    EXPECT_EQ(expanded("#inputMode overwrite\nb { c 1; } b { d 2; }"), "b { d 2; }");
    EXPECT_EQ(expanded("#inputMode protect\na 1; a 2;"), "a 1;");
    EXPECT_EQ(expanded("a 1; #default a 2; #overwrite b { x 1; } #overwrite b { y 1; } a 3;"),
              "a 3; b { y 1; }");
    EXPECT_EQ(expanded("a { x 1; y 2; } b { x 5; #overwrite $..a; }"), "a { x 1; y 2; } b { x 1; y 2; }");
    EXPECT_EQ(expanded("a 1; k b; #default #overwrite a 2; #overwrite $k 3;"), "a 2; k b; b 3;");
    EXPECT_EQ(expanded("m { x 1; s { p 1; r 3; } z 9; } t { x 2; s { p 5; } #default $..m; }"),
              "m { x 1; s { p 1; r 3; } z 9; } t { x 2; s { p 5; } z 9; }");
    EXPECT_EQ(expanded("a { x 1; } a { y 2; #inputMode overwrite\n} a { z 3; }"), "a { z 3; }");
    EXPECT_EQ(expanded("a { x 1; } #inputMode overwrite\na { y 2; #inputMode merge\n}"), "a { y 2; }");
    EXPECT_EQ(refusal("a 1;\n#error a 2;"), "file:2: 'a' is given twice\n    first on line 1\n");
    EXPECT_EQ(refusal("#inputMode merg"), "file:1: unknown input mode 'merg'\n"
                                          "    did you mean 'merge'?  valid modes: default error merge "
                                          "overwrite protect warn\n");
}

TEST(Directives, removeTakesNamesListsAndPatterns)
{
    EXPECT_EQ(expanded("a 1; b 2; c 3; d 4; #remove a\n#remove (b c)"), "d 4;");
    EXPECT_EQ(expanded("aa 1; ab 2; c 3; #remove \"a.*\""), "c 3;");
    EXPECT_EQ(expanded("a 1; b 2; #remove a\na 3;"), "b 2; a 3;");
}

TEST(Directives, evalTakesMacrosInAllItsSpellings)
{
    EXPECT_EQ(expanded("r 2; a #eval{ $r*3 }; b #eval \"${r}*3\"; c (#eval{ 1 } #eval #{ $[r]*3 #});"),
              "r 2; a 6; b 6; c ( 1 6 );");
    EXPECT_EQ(expanded("a 5; b #eval{ cos(degToRad($a)) };"), "a 5; b 0.9961946980917455;");
    EXPECT_EQ(refusal("a #eval{ 1 + };").substr(0, 30), "file:1: #eval: unexpected end ");
}

TEST(Directives, calcIsTakenWhereItIsPlainArithmetic)
{
    EXPECT_EQ(expanded("r 2.5; a #calc \"3*$r\";"), "r 2.5; a 7.5;");
    EXPECT_EQ(refusal("a #calc \"1/2\";"), "file:1: #calc divides whole numbers, which C++ would cut off\n"
                                           "    write #eval { ... } instead\n");
    EXPECT_EQ(refusal("a #calc \"(3+2)/(1+1)\";").substr(0, 34), "file:1: #calc divides whole number");
    EXPECT_EQ(expanded("a2 1.5; b #calc \"(3.+$a2)/(1e0+1.)\";"), "a2 1.5; b 2.25;");
    EXPECT_EQ(refusal("a #calc \"std::sin(1)\";").substr(0, 78),
              "file:1: #calc compiles C++ at run time, which caissonFoam does not do\n    for ");
    EXPECT_EQ(refusal("a #codeStream { code #{ #}; };"),
              "file:1: #codeStream compiles C++ at run time, which caissonFoam does not do\n"
              "    write the value, or #eval { ... } for arithmetic\n");
}

TEST(Directives, unknownOnesAreNamedWithTheNearest)
{
    EXPECT_EQ(refusal("#inlude \"x\"").substr(0, 64),
              "file:1: unknown directive '#inlude'\n    did you mean '#include'?");
    EXPECT_EQ(refusal("a #evl{1};").substr(0, 67),
              "file:1: unknown directive '#evl' in a value\n    did you mean '#eval");
}

TEST(Directives, wordAndMessageAreThoseOfNewerOpenFOAM)
{
    EXPECT_EQ(expanded("n 3; a #word \"layer$n\"; #message \"hello\"\nb 1;"), "n 3; a layer3; b 1;");
}

TEST(Directives, includesAreFoundWhereOpenFOAMFindsThem)
{
    const TemporaryDirectory directory;
    directory.write("constant/soil", "FoamFile { class dictionary; }\nporosity 0.4;");
    directory.write("constant/numbers", "1 2 $x");
    const std::filesystem::path file =
        directory.write("constant/materialProperties", "#include \"soil\"\n"
                                                       "a { #include \"<constant>/soil\"\n }\n"
                                                       "b { #include \"$FOAM_CASE/constant/soil\"\n }\n"
                                                       "n soil; c { #include \"<case>/constant/$n\"\n }\n"
                                                       "#sinclude \"nowhere\"\n"
                                                       "#includeIfPresent \"nowhere\"\n"
                                                       "x 3; list ( #include \"numbers\" );\n"
                                                       "d $porosity;\n");
    const Dictionary dictionary = readDictionary(file, directory.path());
    EXPECT_EQ(dictionary.find("FoamFile"), nullptr) << "the header of an included file is not ours";
    for (const char* key : {"porosity", "a.porosity", "b.porosity", "c.porosity", "d"}) {
        ASSERT_NE(dictionary.findScoped(key), nullptr) << key;
        EXPECT_EQ(dictionary.findScoped(key)->tokens[0].number, 0.4) << key;
    }
    EXPECT_EQ(dictionary.find("list")->tokens.size(), 5U);
}

TEST(Directives, foamCaseIsTheCaseThatIsRead)
{
    const TemporaryDirectory directory;
    directory.write("constant/soil", "porosity 0.4;");
    const std::filesystem::path file =
        directory.write("system/controlDict", "#include \"$FOAM_CASE/constant/soil\"\n");
    setenv("FOAM_CASE", "/nonexistent", 1); // as another case's shell may have it
    EXPECT_NE(readDictionary(file, directory.path()).find("porosity"), nullptr);
    unsetenv("FOAM_CASE");
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(directory.path());
    EXPECT_NE(readDictionary("system/controlDict", ".").find("porosity"), nullptr);
    std::filesystem::current_path(before);
}

TEST(Directives, whatIsIncludedInAValueHasToBeOne)
{
    const TemporaryDirectory directory;
    directory.write("open", "1 2 )");
    const std::filesystem::path file = directory.write("main", "a ( #include \"open\"\n;");
    EXPECT_THROW(static_cast<void>(readDictionary(file, directory.path())), InputError);
    directory.write("open", "1; b 2");
    directory.write("main", "a #include \"open\"\n;");
    EXPECT_THROW(static_cast<void>(readDictionary(file, directory.path())), InputError);
}

TEST(Directives, includesThatFailNameTheLine)
{
    const TemporaryDirectory directory;
    directory.write("cycle", "#include \"cycle\"\n");
    directory.write("bad", "\n\nb 1\n");
    const auto report = [&](const std::string& text) -> std::string {
        const std::filesystem::path file = directory.write("main", text);
        try {
            static_cast<void>(readDictionary(file, directory.path(), "main"));
        } catch (const InputError& error) {
            return error.problems().at(0).where.file.substr(error.problems()[0].where.file.rfind('/') + 1) +
                   ":" + std::to_string(error.problems()[0].where.line) + ": " + error.problems()[0].message;
        }
        return "accepted";
    };
    EXPECT_EQ(report("a 1;\n#include \"missing\"\n"),
              "main:2: cannot open the included file '" + (directory.path() / "missing").string() + "'");
    EXPECT_EQ(report("#include \"cycle\"\n"), "cycle:1: files include each other without end");
    EXPECT_EQ(report("#include \"bad\"\n"), "bad:3: 'b' has no end");
}

TEST(Directives, textInMemoryMayNotInclude)
{
    EXPECT_EQ(refusal("a 1;\n#include \"/etc/passwd\""),
              "file:2: #include is not allowed here\n    this text comes from no file\n");
    EXPECT_EQ(refusal("a #include \"/etc/passwd\";"),
              "file:1: #include is not allowed here\n    this text comes from no file\n");
    EXPECT_EQ(refusal("#includeFunc residuals"),
              "file:1: #includeFunc is not allowed here\n    this text comes from no file\n");
    EXPECT_EQ(refusal("#includeEtc \"controlDict\""),
              "file:1: #includeEtc is not allowed here\n    this text comes from no file\n");
}

TEST(Directives, includeFuncTakesFieldsAndKeys)
{
    const TemporaryDirectory directory;
    directory.write("system/mag", "type mag; field p; writeControl timeStep;");
    const std::filesystem::path file =
        directory.write("system/controlDict", "functions { #includeFunc mag(U,writeControl=writeTime)\n }");
    const Dictionary dictionary = readDictionary(file, directory.path());
    const Dictionary* function =
        dictionary.findDictionary("functions")->findDictionary("mag(U,writeControl=writeTime)");
    ASSERT_NE(function, nullptr);
    EXPECT_EQ(function->find("field")->tokens[0].text, "U");
    EXPECT_EQ(function->find("writeControl")->tokens[0].text, "writeTime");
}

} // namespace caisson
