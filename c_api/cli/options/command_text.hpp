// What a command takes, and what its help says: the text commands/NAME.txt, which commands/embed.sh
// brings into the program. The help, the manual page and the completion of shells are made of it:
//
//     solve MESH (mesh)                    the name, and the operands with the use of their files
//     Solves the functions ...             the summary
//
//     Each control point's function ...    paragraphs; lines that begin with a blank stay unchanged
//
//     Options:                             or another heading of a group of options
//     --mode FIELD  (input)                an option, its value, and marks
//         a function whose values ...      its help, with an indentation of four
//     --curve --rigid                      options whose help is in shared.txt
//
//     Examples:
//       harmorph solve ...                 lines that stay unchanged
//
// Marks are the use of a file, `mesh`, `input`, `input behind =` (of NAME=FILE), `output` or `moved
// mesh`; `output .ENDING with --OPTION`: see Option::ending; `sets --OPTION VALUE ...`: see
// Option::sets.
#pragma once

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
    std::string name;  // "MESH"
    FileUse use = FileUse::none;
};

// An option with the value that stands for it where it is not given.
struct Setting {
    std::string option, value;
};

struct Option {
    std::string name;   // "--degree"
    std::string value;  // the value that follows, for the help; empty: the option has no value
    std::string help;
    std::string group;  // the heading in the help
    FileUse use = FileUse::none;
    // An output that the command writes without the option, too: where -o (and the option `with`,
    // unless that is empty) is given, the name of the output is that of -o and this ending.
    std::string ending, with;
    std::vector<Setting> sets;  // options that this one chooses where they are not given
};

struct CommandText {
    std::string name;
    std::vector<Operand> operands;  // all must be given
    std::string summary;            // one line
    std::string details;            // paragraphs
    std::vector<Option> options;
    std::string examples;  // lines; each ends with \n

    const Option* find(std::string_view option) const;  // NULL: the command does not know it
};

CommandText command_text(std::string_view command);
std::string help_text(const CommandText& command);  // at most 80 columns wide

std::string_view embedded_text(std::string_view name);
struct EmbeddedText {
    const char *name, *text;
};
extern const EmbeddedText command_texts[];  // ends with a name that is NULL

}  // namespace cli
