// The command line: what a command understands, and the words it was given.
#pragma once

#include "basics/failure.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace cli {

// What a command does with the file that an operand or the value of an option names.
enum class FileUse {
    none,                // the word is no file
    mesh,                // reads a mesh, with the files beside the mesh that belong to it
    input,               // reads the file
    input_after_equals,  // reads the file that stands behind the first `=` of the value, if any
    output,              // writes the file
    moved_mesh           // writes a moved mesh, which may replace the mesh of the first operand
};

struct Operand {
    const char* name;  // "MESH"
    FileUse use;
};

struct Option {
    const char* name;   // "--degree"
    const char* value;  // what follows it, for the help; NULL: nothing does
    const char* help;
    FileUse use = FileUse::none;
    // An output that the command writes without the option, too: where -o (and the option `with`,
    // unless that is NULL) is given, the name of the output is that of -o and this ending.
    const char* ending = nullptr;
    const char* with = nullptr;
};

struct NamedFile {
    FileUse use;
    std::string name, path;  // of the operand or the option, and of the file
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
    const char* details;            // paragraphs, each line ended
    std::vector<Option> options;
    const char* examples;           // lines, each ended
    void (*run)(const Arguments&);  // throws a Failure if the result is not usable
};

// Options as "--name value" or "--name=value", in any order with the operands; "--" ends them.
class Arguments {
public:
    Arguments(const Command& command,
              const std::vector<std::string>& words);  // refuses what the command does not know

    const std::string& operand(std::size_t index) const { return operands_[index]; }
    std::vector<NamedFile> files() const;  // all files that the words name or imply
    bool has(std::string_view option) const;
    std::vector<std::string> all(
        std::string_view option) const;               // of an option that may be repeated
    std::string text(std::string_view option) const;  // must be given
    // The file of an option that may have an ending; empty if there is none to write.
    std::string output(std::string_view option) const;
    std::int32_t whole(std::string_view option, std::int32_t fallback, std::int32_t low,
                       std::int32_t high) const;
    // "3,5": must be given.
    std::vector<std::int32_t> whole_list(std::string_view option, std::int32_t low,
                                         std::int32_t high) const;
    std::int32_t choice(std::string_view option,
                        const std::vector<Choice>& choices) const;  // the first: if not given
    double positive(std::string_view option, double fallback) const;
    double real(std::string_view option, double fallback, double low,
                double high) const;  // low and high are allowed

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

// An option of every command that computes.
extern const Option threads_option;
std::int32_t threads_of(const Arguments& arguments);

}  // namespace cli
