#include "DictionaryTestSupport.h"

#include <cstdlib>

namespace caisson {

TEST(Macros, scopesAreThoseOfOpenFOAM)
{
    EXPECT_EQ(expanded("a 1; b $a; c ${a};"), "a 1; b 1; c 1;");
    EXPECT_EQ(expanded("a { b 1; c { d 2; e $..b; f $b; g $.d; } } h { i $:a.b; j $^a.b; }"),
              "a { b 1; c { d 2; e 1; f 1; g 2; } } h { i 1; j 1; }");
    EXPECT_EQ(expanded("a { c { d 2; } } e $a.c.d; f $a/c/d; g ${/a/c/d}; h { i $../a/c/d; }"),
              "a { c { d 2; } } e 2; f 2; g 2; h { i 2; }");
    EXPECT_EQ(expanded("a one; b { a two; c $a; d $:a; }"), "a one; b { a two; c two; d one; }");
    EXPECT_EQ(expanded("a.b 1; c $a.b;"), "a.b 1; c 1;"); // keywords may hold dots
}

TEST(Macros, valuesIgnorePatternsButMergedDictionariesUseThem)
{
    EXPECT_EQ(expanded("internalField uniform 5; b { \".*\" { type x; } m { value $internalField; } }"),
              "internalField uniform 5; b { \".*\" { type x; } m { value uniform 5; } }");
    EXPECT_EQ(expanded("\"(U|k)\" { s 1; } UFinal { $U; t 2; }"), "\"(U|k)\" { s 1; } UFinal { s 1; t 2; }");
}

TEST(Macros, dictionariesAreMergedCopiedAndSpliced)
{
    EXPECT_EQ(expanded("a { x 1; y 2; } b { $a; x 5; } c { x 5; $a; } d $a;"),
              "a { x 1; y 2; } b { x 5; y 2; } c { x 1; y 2; } d { x 1; y 2; }");
    EXPECT_EQ(expanded("a { x 1; y { z 2; } } l ( first { $a; w 3; } );"),
              "a { x 1; y { z 2; } } l ( first { x 1 ; y { z 2 ; } ; w 3 ; } );");
    EXPECT_EQ(expanded("p (1 2); l ($p $p);"), "p ( 1 2 ); l ( ( 1 2 ) ( 1 2 ) );");
    EXPECT_EQ(refusal("a { x 1; } b word $a;"), "file:1: '$a' is a dictionary, which is no part of a value\n"
                                                "    keyword $dictionary;  is a copy of it\n");
}

TEST(Macros, defaultsAlternativesAndNestedNamesAreTaken)
{
    EXPECT_EQ(expanded("b ${a:-5};"), "b 5;");
    EXPECT_EQ(expanded("a 1; b ${a:-5};"), "a 1; b 1;");
    EXPECT_EQ(expanded("a 1; b ${a:+5}; c ${x:+5};"), "a 1; b 5; c;");
    EXPECT_EQ(expanded("b ${a:-${c:-7}};"), "b 7;");
    EXPECT_EQ(expanded("foo 1; n foo; b ${${n}};"), "foo 1; n foo; b 1;");
    EXPECT_EQ(expanded("n foo; _foo { z 1; } ${_${n}};"), "n foo; _foo { z 1; } z 1;");
    EXPECT_EQ(expanded("n foo; ${_${n}}; c 1;"), "n foo; c 1;"); // a computed name may stand for nothing
}

TEST(Macros, theEnvironmentIsAskedLast)
{
    setenv("CAISSON_TEST_LENGTH", "2.5", 1);
    EXPECT_EQ(expanded("a $CAISSON_TEST_LENGTH;"), "a 2.5;");
    EXPECT_EQ(expanded("CAISSON_TEST_LENGTH 3; a $CAISSON_TEST_LENGTH;"), "CAISSON_TEST_LENGTH 3; a 3;");
    unsetenv("CAISSON_TEST_LENGTH");
}

TEST(Macros, textFromOutsideHasToBeAWholeValue)
{
    setenv("CAISSON_TEST_TEXT", "1; b 2", 1);
    EXPECT_EQ(refusal("a $CAISSON_TEST_TEXT;"),
              "file:1: '1; b 2', which '$CAISSON_TEST_TEXT' stands for, is no value\n"
              "    a ';' or a bracket without its other half is in it\n");
    setenv("CAISSON_TEST_TEXT", "(1 2", 1);
    EXPECT_NE(refusal("a $CAISSON_TEST_TEXT);"), "accepted");
    setenv("CAISSON_TEST_TEXT", "{ c 3; } (1)", 1);
    EXPECT_EQ(expanded("a $CAISSON_TEST_TEXT;"), "a { c 3 ; } ( 1 );");
    unsetenv("CAISSON_TEST_TEXT");
}

TEST(Macros, whatTheyReferToCountsAsAKnownKey)
{
    const Dictionary dictionary =
        parseDictionary("radius 2; b { length 1; } d #eval{ 2*$:b.length + $radius };");
    EXPECT_TRUE(dictionary.usedAsMacro("radius"));
    EXPECT_TRUE(dictionary.usedAsMacro("b"));
    EXPECT_FALSE(dictionary.usedAsMacro("d"));
    const Dictionary spellings = parseDictionary("a { x 1; } b { x 2; } c { x 3; } e { x 4; }"
                                                 "f { ${a}; } g { $..b; } h $:c; i ${e}; j ${none:-1};");
    for (const char* name : {"a", "b", "c", "e", "none"}) {
        EXPECT_TRUE(spellings.usedAsMacro(name)) << name;
    }
}

TEST(Macros, unknownNamesAreNamedWithTheNearest)
{
    EXPECT_EQ(refusal("radius 1;\nb $raduis;"),
              "file:2: nothing is called 'raduis' for the macro '$raduis'\n    did you mean '$radius'?\n");
    EXPECT_EQ(refusal("a 1; $nothingLikeIt;"),
              "file:1: nothing is called 'nothingLikeIt' for the macro '$nothingLikeIt'\n"
              "    neither an entry above nor an environment variable\n");
    EXPECT_EQ(refusal("a 1;\nb { $a; }"), "file:2: '$a;' merges a dictionary, but 'a' is a value\n"
                                          "    it is defined on line 1\n");
    EXPECT_EQ(refusal("a { b $...c; }"), "file:1: '$...c' goes above the top of the file\n");
}

} // namespace caisson
