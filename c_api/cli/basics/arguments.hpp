// The command line: what a command understands, and the words it was given.
#pragma once

#include "basics/failure.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace cli {

struct Option {
    const char* name;   // "--degree"
    const char* value;  // what follows it, for the help; NULL: nothing does
    const char* help;
};

std::vector<Option> operator+(std::vector<Option> some, const std::vector<Option>& others);

struct Choice {
    const char* name;
    std::int32_t number;
};

class Arguments;

struct Command {
    const char* name;
    std::vector<const char*> operands;  // "MESH"; all must be given
    const char* summary;                // one line
    const char* details;                // paragraphs, each line ended
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
    bool has(std::string_view option) const;
    std::vector<std::string> all(
        std::string_view option) const;               // of an option that may be repeated
    std::string text(std::string_view option) const;  // must be given
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

    const Command& command_;
    std::vector<std::string> operands_;
    std::vector<Given> given_;
};

std::string help_text(const Command& command);

// An option of every command that computes.
extern const Option threads_option;
std::int32_t threads_of(const Arguments& arguments);

}  // namespace cli
