#include "options/command_text.hpp"

#include "basics/failure.hpp"
#include "basics/text.hpp"

#include <algorithm>

namespace cli {

namespace {

constexpr std::size_t help_column = 26;
constexpr std::string_view indentation = "    ", examples_heading = "Examples:";

// Returns the first word, and takes it and the blanks behind it away.
std::string take_word(std::string_view& text) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string word(text.substr(0, end));
    text = trimmed(text.substr(end));
    return word;
}

// Returns what stands in the parentheses with which the text begins, and takes them away; empty if
// there are none.
std::string take_mark(std::string_view& text) {
    if (text.empty() || text[0] != '(') return "";
    const std::size_t end = text.find(')');
    const std::string mark(text.substr(1, end - 1));
    text = trimmed(text.substr(end + 1));
    return mark;
}

constexpr struct {
    std::string_view words;
    FileUse use;
} file_uses[] = {{"mesh", FileUse::mesh},
                 {"input behind =", FileUse::input_after_equals},
                 {"input", FileUse::input},
                 {"output", FileUse::output},
                 {"moved mesh", FileUse::moved_mesh}};

// Returns the use that the mark begins with, and takes its words away.
FileUse take_use(std::string_view& mark) {
    for (const auto& one : file_uses) {
        if (mark.substr(0, one.words.size()) != one.words) continue;
        mark = trimmed(mark.substr(one.words.size()));
        return one.use;
    }
    return FileUse::none;
}

// mark: "input", "output .ending with --option", or "sets --option value --option value".
void apply_mark(Option& option, std::string_view mark) {
    option.use = take_use(mark);
    while (!mark.empty()) {
        const std::string word = take_word(mark);
        if (word[0] == '.') option.ending = word;
        else if (word == "with") option.with = take_word(mark);
        else if (word[0] == '-') option.sets.push_back({word, take_word(mark)});
        else if (word != "sets")
            throw Failure(exit_unusable, option.name + ": a text marks the option by " + word);
    }
}

// Reads a text line by line.
class Lines {
public:
    explicit Lines(std::string_view text) : rest_(text) {}
    bool has() const { return !rest_.empty(); }
    std::string_view next() const { return rest_.substr(0, rest_.find('\n')); }
    std::string_view take() {
        const std::string_view line = next();
        rest_.remove_prefix(std::min(line.size() + 1, rest_.size()));
        return line;
    }

private:
    std::string_view rest_;
};

bool is_help(std::string_view line) { return line.substr(0, 4) == indentation; }

Option read_option(std::string_view line, Lines& lines) {
    Option option;
    const std::size_t gap = std::min(line.find("  "), line.size());
    std::string_view words = line.substr(0, gap), behind = trimmed(line.substr(gap));
    option.name = take_word(words);
    option.value = words;
    apply_mark(option, take_mark(behind));
    while (is_help(lines.next()))
        option.help.append(option.help.empty() ? "" : " ").append(trimmed(lines.take()));
    return option;
}

// Reads groups of options up to the examples. A line of names without help stands for the options
// of these names among the shared ones.
void read_options(Lines& lines, std::vector<Option>& options, const CommandText& shared) {
    std::string group;
    while (lines.has() && lines.next() != examples_heading) {
        std::string_view line = lines.take();
        if (line.empty()) continue;
        if (line[0] != '-') {
            group = line;
        } else if (is_help(lines.next())) {
            options.push_back(read_option(line, lines));
            options.back().group = group;
        } else {
            while (!line.empty()) {
                const std::string name = take_word(line);
                const Option* const known = shared.find(name);
                if (known == nullptr) throw Failure(exit_unusable, name + " has no text");
                options.push_back(*known);
                options.back().group = group;
            }
        }
    }
}

std::string paragraphs(std::string_view text) {
    std::string out, paragraph;
    const auto close = [&] {
        if (!paragraph.empty()) out += wrapped(paragraph, 0) + '\n';
        paragraph.clear();
    };
    for (Lines lines(text); lines.has();) {
        const std::string_view line = lines.take();
        const bool stays = line.empty() || line[0] == ' ';
        if (stays) {
            close();
            out.append(line) += '\n';
        } else {
            paragraph.append(paragraph.empty() ? "" : " ").append(line);
        }
    }
    close();
    return out;
}

std::string help_of(const Option& option) {
    std::string text = option.help;
    for (const Setting& setting : option.sets) text += ' ' + setting.option + ' ' + setting.value;
    const std::string value = option.value.empty() ? "" : ' ' + option.value;
    return help_line(option.name + value, text, help_column);
}

}  // namespace

const Option* CommandText::find(std::string_view option) const {
    const auto known = std::find_if(options.begin(), options.end(),
                                    [option](const Option& one) { return option == one.name; });
    return known == options.end() ? nullptr : &*known;
}

std::string_view embedded_text(std::string_view name) {
    const EmbeddedText* text = command_texts;
    while (text->name != nullptr && name != text->name) ++text;
    if (text->name == nullptr)
        throw Failure(exit_unusable, "the program has no text " + in_quotes(name));
    return text->text;
}

CommandText command_text(std::string_view name) {
    CommandText shared, command;
    Lines of_shared(embedded_text("shared")), lines(embedded_text(name));
    read_options(of_shared, shared.options, shared);
    std::string_view line = lines.take();
    command.name = take_word(line);
    while (!line.empty()) {
        command.operands.push_back({take_word(line), FileUse::none});
        const std::string mark = take_mark(line);
        std::string_view words = mark;
        command.operands.back().use = take_use(words);
    }
    command.summary = lines.take();
    while (lines.has() && lines.next() != "Options:") command.details.append(lines.take()) += '\n';
    read_options(lines, command.options, shared);
    lines.take();
    while (lines.has()) command.examples.append(lines.take()) += '\n';
    return command;
}

std::string help_text(const CommandText& command) {
    std::string text = "Usage: harmorph " + command.name;
    for (const Operand& operand : command.operands) text += ' ' + operand.name;
    text += " [options]\n\n" + command.summary + ".\n" + paragraphs(command.details);
    std::string group;
    for (const Option& option : command.options) {
        if (option.group != group) {
            text += (group.empty() ? "" : "\n") + option.group + '\n';
            if (group.empty()) text += help_line("--help", "this text", help_column);
            group = option.group;
        }
        text += help_of(option);
    }
    return text + '\n' + std::string(examples_heading) + '\n' + command.examples;
}

}  // namespace cli
