#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace caisson {

/// The content of an OpenFOAM file (mesh, field or cloud), read item by item. The header tells the class, the
/// format, and for binary files the widths of labels and scalars (`arch "LSB;label=32;scalar=64"`).
///
/// Not for dictionaries: no macros, no directives; made for long lists of numbers.
class FoamScanner
{
public:
    /// Reads the file (or .gz) and its header; a file without header is ascii of no class.
    /// @param displayName  how messages call the file
    /// @throws InputError where the file is missing (with `hint`) or its header is broken
    FoamScanner(const std::filesystem::path& file, std::string displayName, const std::string& hint = {});

    [[nodiscard]] const std::string& className() const { return className_; }
    [[nodiscard]] bool binary() const { return binary_; }

    /// The next character that is neither white space nor comment; '\0' at the end of the file.
    char peek();
    bool accept(char c); ///< takes `c` where it comes next
    void expect(char c);
    std::string word(); ///< up to white space or one of ; { } ( ) "; quotes are taken off
    int label();        ///< an integer written in ascii
    double scalar();    ///< a number written in ascii
    bool atNumber();
    void skipEntry(); ///< over the rest of an entry: to behind its ';', or a '{...}' block
    void skipLine();

    /// `N ( ... )` or `N { v }`, in ascii also `( ... )`; an optional `List<...>` in front is taken.
    std::vector<int> labelList();
    /// The same for items of `components` numbers, interleaved.
    std::vector<double> scalarList(int components);
    /// Raw bytes of a binary file.
    std::string_view bytes(std::size_t count);
    /// `count` raw labels or scalars of the widths that the header gives.
    void rawLabels(std::size_t count, std::vector<int>& values);
    void rawScalars(std::size_t count, std::vector<double>& values);

    /// @throws InputError at the present place
    [[noreturn]] void fail(const std::string& message, const std::string& hint = {}) const;

private:
    template <class Read, class Raw>
    void list(Read readItem, Raw readRaw);
    void readHeader();
    void skipSpace();
    [[nodiscard]] std::string preview() const; ///< what comes next, for messages

    std::string name_;
    std::string text_;
    std::size_t at_ = 0;
    std::string className_;
    bool binary_ = false;
    int labelBytes_ = 4;
    int scalarBytes_ = 8;
};

} // namespace caisson
