#include "options/arguments.hpp"

#include "basics/numbers.hpp"
#include "basics/text.hpp"
#include "files/output_file.hpp"

#include <algorithm>
#include <cctype>
#include <cstring>

namespace cli {

Arguments::Arguments(const CommandText& command, const std::vector<std::string>& words)
    : command_(command) {
    bool options_ended = false;
    for (std::size_t at = 0; at < words.size(); ++at) {
        const std::string& word = words[at];
        if (!options_ended && word == "--") {
            options_ended = true;
        } else if (!options_ended && word.size() > 1 && word[0] == '-') {
            at = take_option(words, at);
        } else {
            operands_.push_back(word);
        }
    }
    const std::size_t wanted = command_.operands.size();
    if (operands_.size() < wanted) refuse(command_.operands[operands_.size()].name + " is missing");
    if (operands_.size() > wanted)
        refuse(in_quotes(operands_[wanted]) + " is one argument too many");
    apply_settings();
}

void Arguments::apply_settings() {
    for (const Option& option : command_.options) {
        if (option.sets.empty() || !has(option.name)) continue;
        for (const Setting& setting : option.sets) {
            if (!has(setting.option)) given_.push_back({setting.option, setting.value});
        }
    }
}

std::string word_of_shell(const std::string& word) {
    const auto is_plain = [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) ||
               std::strchr("-_./,:=+@%", c) != nullptr;
    };
    if (!word.empty() && std::all_of(word.begin(), word.end(), is_plain)) return word;
    std::string quoted = "'";
    for (const char c : word) quoted += c == '\'' ? "'\\''" : std::string(1, c);
    return quoted + "'";
}

std::string Arguments::written_out() const {
    std::string line = "harmorph " + command_.name;
    for (const std::string& operand : operands_) line += ' ' + word_of_shell(operand);
    bool is_set = false;
    for (const Given& given : given_) {
        const Option& option = *command_.find(given.option);
        is_set = is_set || !option.sets.empty();
        if (!option.sets.empty()) continue;
        line += ' ' + given.option;
        if (!option.value.empty()) line += ' ' + word_of_shell(given.value);
    }
    return is_set ? line : "";
}

// Returns the index of the last word of the option: its value, if the value is a word of its own.
std::size_t Arguments::take_option(const std::vector<std::string>& words, std::size_t at) {
    const std::string& word = words[at];
    const std::size_t equals = word.compare(0, 2, "--") == 0 ? word.find('=') : std::string::npos;
    const std::string name = word.substr(0, equals);
    const Option* const known = command_.find(name);
    if (known == nullptr) {
        std::vector<std::string> names;
        for (const Option& option : command_.options) names.push_back(option.name);
        refuse("the option " + in_quotes(name) + " is unknown" + did_you_mean(name, names));
    }
    std::string value;
    if (equals != std::string::npos) {
        if (known->value.empty()) refuse(name + " takes no value");
        value = word.substr(equals + 1);
    } else if (!known->value.empty()) {
        if (++at == words.size()) refuse(name + " needs a value: " + known->value);
        value = words[at];
    }
    given_.push_back({name, value});
    return at;
}

std::string Arguments::output(const Option& option) const {
    if (has(option.name)) return text(option.name);
    const bool is_implied = !option.ending.empty() && has("-o") &&
                            (option.with.empty() || has(option.with)) && !is_device(text("-o"));
    return is_implied ? text("-o") + option.ending : "";
}

std::string Arguments::output(std::string_view option) const {
    return output(*command_.find(option));
}

std::vector<NamedFile> Arguments::files() const {
    std::vector<NamedFile> files;
    const auto add = [&files](FileUse use, const std::string& name, const std::string& path) {
        if (use != FileUse::none && !path.empty()) files.push_back({use, name, path});
    };
    for (std::size_t k = 0; k < operands_.size(); ++k)
        add(command_.operands[k].use, command_.operands[k].name, operands_[k]);
    for (const Option& option : command_.options) {
        for (const std::string& value : all(option.name)) {
            const bool is_bound = option.use == FileUse::input_after_equals;
            const std::size_t equals = equals_behind_names(value, 0);
            if (!is_bound) add(option.use, option.name, value);
            if (is_bound && equals != value.npos)
                add(FileUse::input, option.name, value.substr(equals + 1));
        }
        if (!has(option.name)) add(option.use, option.name, output(option));
    }
    return files;
}

bool Arguments::has(std::string_view option) const {
    return std::any_of(given_.begin(), given_.end(),
                       [option](const Given& given) { return given.option == option; });
}

std::vector<std::string> Arguments::all(std::string_view option) const {
    std::vector<std::string> values;
    for (const Given& given : given_) {
        if (given.option == option) values.push_back(given.value);
    }
    return values;
}

std::string Arguments::text(std::string_view option) const {
    const std::vector<std::string> values = all(option);
    if (values.empty()) refuse(std::string(option) + " is missing");
    if (values.size() > 1) refuse(std::string(option) + " is given twice");
    return values[0];
}

std::int32_t Arguments::whole(std::string_view option, std::int32_t fallback, std::int32_t low,
                              std::int32_t high) const {
    if (!has(option)) return fallback;
    std::int32_t value = 0;
    if (!parse(text(option), value) || value < low || value > high) {
        refuse(std::string(option) + " expects a whole number between " + std::to_string(low) +
               " and " + std::to_string(high) + ", not " + in_quotes(text(option)));
    }
    return value;
}

std::vector<std::int32_t> Arguments::whole_list(std::string_view option, std::int32_t low,
                                                std::int32_t high) const {
    const std::string list = text(option);
    std::vector<std::int32_t> values;
    const bool is_list = parse_list(list, values);
    const auto is_outside = [=](std::int32_t value) { return value < low || value > high; };
    if (!is_list || std::any_of(values.begin(), values.end(), is_outside)) {
        refuse(std::string(option) + " expects whole numbers between " + std::to_string(low) +
               " and " + std::to_string(high) + " with commas between them, not " +
               in_quotes(list));
    }
    return values;
}

std::vector<double> Arguments::number_list(std::string_view option) const {
    const std::string list = text(option);
    std::vector<double> values;
    if (!parse_list(list, values))
        refuse(std::string(option) + " expects numbers with commas between them, not '" + list +
               "'");
    return values;
}

NamedNumbers Arguments::named_numbers(std::string_view option, const std::string& value,
                                      std::size_t count, const char* form) const {
    const std::size_t equals = value.find('=');
    NamedNumbers found = {value.substr(0, equals), {}};
    if (equals == std::string::npos ||
        !parse_list(std::string_view(value).substr(equals + 1), found.numbers) ||
        found.numbers.size() != count)
        refuse(std::string(option) + " expects " + form + ", found " + in_quotes(value));
    return found;
}

double Arguments::positive(std::string_view option, double fallback) const {
    if (!has(option)) return fallback;
    double value = 0;
    if (!parse(text(option), value) || value <= 0) {
        refuse(std::string(option) + " expects a number above 0, not " + in_quotes(text(option)));
    }
    return value;
}

double Arguments::real(std::string_view option, double fallback, double low, double high) const {
    if (!has(option)) return fallback;
    double value = 0;
    if (!parse(text(option), value) || value < low || value > high) {
        refuse(std::string(option) + " expects a number between " + brief(low) + " and " +
               brief(high) + ", not " + in_quotes(text(option)));
    }
    return value;
}

std::int32_t Arguments::choice(std::string_view option, const std::vector<Choice>& choices) const {
    return has(option) ? choice(option, text(option), choices) : choices[0].number;
}

std::int32_t Arguments::choice(std::string_view option, const std::string& given,
                               const std::vector<Choice>& choices) const {
    std::string names;
    for (const Choice& choice : choices) {
        if (given == choice.name) return choice.number;
        names += names.empty() ? "" : ", ";
        names += choice.name;
    }
    refuse(std::string(option) + " must be one of " + names + ", not " + in_quotes(given));
}

void Arguments::refuse(std::string_view message) const {
    throw Failure(exit_usage, (command_.name + ": ").append(message) + "\nTry: harmorph " +
                                  command_.name + " --help");
}

std::int32_t threads_of(const Arguments& arguments) {
    return arguments.whole("--threads", 1, 1, 256);
}

}  // namespace cli
