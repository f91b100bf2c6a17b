// Paths as text, and what lies at them. Only the files of this folder ask the operating system, so
// that all others can be compiled where the C++ library has no <filesystem>.
#pragma once

#include <string>
#include <vector>

namespace cli {

std::string folder_of(const std::string& path);  // without the last name; may be empty
std::string last_name(const std::string& path);  // behind the last slash
// The ending of the last name, from its last dot on; empty if the name has none.
std::string ending_of(const std::string& path);
std::string without_ending(const std::string& path);
// The path without the ending .gz, if the path has this ending.
std::string without_gz(const std::string& path);
// The path of `name` in a folder; an absolute name is that path.
std::string path_in(const std::string& folder, const std::string& name);
// The path without "." and "folder/..", for comparison.
std::string normal_path(const std::string& path);

// An entry that cannot be looked at counts as absent.
bool exists(const std::string& path);
bool is_folder(const std::string& path);
bool is_regular_file(const std::string& path);

void make_folders(const std::string& path);  // throws a Failure
// The names of the regular files in a folder; none if the folder cannot be read.
std::vector<std::string> files_in(const std::string& folder);

// Copies a file into the folder for temporary files, readable by the owner alone, and returns the
// path of the copy, which the caller removes. Throws a Failure.
std::string temporary_copy(const std::string& path);

}  // namespace cli
