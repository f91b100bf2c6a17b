// The command line: the operands and options of a command, and the words that the user gave.
#pragma once

#include "basics/failure.hpp"
#include "options/command_text.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace cli {

struct NamedFile {
    FileUse use;
    std::string name, path;  // name: the operand or the option
};

struct NamedNumbers {
    std::string name;
    std::vector<double> numbers;
};

struct Choice {
    const char* name;
    std::int32_t number;
};

// Options are written "--name value" or "--name=value", in any order with the operands; "--" ends
// the options.
class Arguments {
public:
    // Refuses operands and options that the command does not have.
    Arguments(const CommandText& command, const std::vector<std::string>& words);

    const std::vector<Option>& options() const { return command_.options; }
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
    // Read a list such as "3,5"; the option must be given.
    std::vector<std::int32_t> whole_list(std::string_view option, std::int32_t low,
                                         std::int32_t high) const;
    std::vector<double> number_list(std::string_view option) const;
    // Returns the first choice if the option is not given.
    std::int32_t choice(std::string_view option, const std::vector<Choice>& choices) const;
    // Returns the choice with the name `given`, which is a value of an option that may be repeated.
    std::int32_t choice(std::string_view option, const std::string& given,
                        const std::vector<Choice>& choices) const;
    double positive(std::string_view option, double fallback) const;
    // Reads a number from low to high; both bounds are allowed.
    double real(std::string_view option, double fallback, double low, double high) const;

    // Returns the command line in which the options that others have set are written out; empty if
    // there is no such option.
    std::string written_out() const;

    // Splits a value NAME=NUMBER,NUMBER of an option. Refuses another value, or another count of
    // numbers, and says that `form` is expected.
    NamedNumbers named_numbers(std::string_view option, const std::string& value, std::size_t count,
                               const char* form) const;

    [[noreturn]] void refuse(std::string_view message) const;  // wrong usage of this command

private:
    struct Given {
        std::string option, value;
    };
    std::size_t take_option(const std::vector<std::string>& words, std::size_t at);
    void apply_settings();
    std::string output(const Option& option) const;

    const CommandText& command_;
    std::vector<std::string> operands_;
    std::vector<Given> given_;
};

std::int32_t threads_of(const Arguments& arguments);  // every command that computes has --threads

// Returns the word as a shell takes it.
std::string word_of_shell(const std::string& word);

}  // namespace cli
