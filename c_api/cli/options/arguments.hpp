// The command line: the operands and options of a command, and the words that the user gave.
#pragma once

#include "basics/failure.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace cli {

// The use that a command makes of the file that an operand or the value of an option names.
enum class FileUse {
    none,                // the word is no file
    mesh,                // reads a mesh, with the files beside the mesh that belong to it
    input,               // reads the file
    input_after_equals,  // reads the file whose name follows the `=` behind the names of the value
    output,              // writes the file
    moved_mesh           // writes a moved mesh, which may replace the mesh of the first operand
};

struct Operand {
    const char* name;  // "MESH"
    FileUse use;
};

struct Option {
    const char* name;   // "--degree"
    const char* value;  // the value that follows, for the help; NULL: the option has no value
    const char* help;
    FileUse use = FileUse::none;
    // An output that the command writes without the option, too: where -o (and the option `with`,
    // unless that is NULL) is given, the name of the output is that of -o and this ending.
    const char* ending = nullptr;
    const char* with = nullptr;
};

struct NamedFile {
    FileUse use;
    std::string name, path;  // name: the operand or the option
};

std::vector<Option> operator+(std::vector<Option> some, const std::vector<Option>& others);

struct Choice {
    const char* name;
    std::int32_t number;
};

class Arguments;

struct Command {
    const char* name;
    std::vector<Operand> operands;  // all must be given
    const char* summary;            // one line
    const char* details;            // paragraphs; each line ends with \n
    std::vector<Option> options;
    const char* examples;           // lines; each ends with \n
    void (*run)(const Arguments&);  // throws a Failure if the result is not usable
};

// Options are written "--name value" or "--name=value", in any order with the operands; "--" ends
// the options.
class Arguments {
public:
    // Refuses operands and options that the command does not have.
    Arguments(const Command& command, const std::vector<std::string>& words);

    const std::string& operand(std::size_t index) const { return operands_[index]; }
    std::vector<NamedFile> files() const;  // all files that the words name or imply
    bool has(std::string_view option) const;
    // Returns all values of an option that may be repeated.
    std::vector<std::string> all(std::string_view option) const;
    std::string text(std::string_view option) const;  // the option must be given
    // Returns the file of an option that may have an ending; empty if there is none to write.
    std::string output(std::string_view option) const;
    std::int32_t whole(std::string_view option, std::int32_t fallback, std::int32_t low,
                       std::int32_t high) const;
    // Reads a list such as "3,5"; the option must be given.
    std::vector<std::int32_t> whole_list(std::string_view option, std::int32_t low,
                                         std::int32_t high) const;
    // Returns the first choice if the option is not given.
    std::int32_t choice(std::string_view option, const std::vector<Choice>& choices) const;
    // Returns the choice with the name `given`, which is a value of an option that may be repeated.
    std::int32_t choice(std::string_view option, const std::string& given,
                        const std::vector<Choice>& choices) const;
    double positive(std::string_view option, double fallback) const;
    // Reads a number from low to high; both bounds are allowed.
    double real(std::string_view option, double fallback, double low, double high) const;

    [[noreturn]] void refuse(std::string_view message) const;  // wrong usage of this command

private:
    struct Given {
        std::string option, value;
    };
    std::size_t take_option(const std::vector<std::string>& words, std::size_t at);
    const Option* find(std::string_view option) const;  // NULL: the command does not know it
    std::string output(const Option& option) const;

    const Command& command_;
    std::vector<std::string> operands_;
    std::vector<Given> given_;
};

std::string help_text(const Command& command);

// Every command that computes has this option.
extern const Option threads_option;
std::int32_t threads_of(const Arguments& arguments);

}  // namespace cli
