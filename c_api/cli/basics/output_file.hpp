// Output files that appear whole or not at all: they are written under temporary names and renamed
// by commit().
#pragma once

#include <deque>
#include <fstream>
#include <string>

namespace cli {

// A device or a pipe, into which one writes; nothing belongs beside it.
bool is_device(const std::string& path);

// Do both paths lead to one file, by symbolic or hard links or another spelling? Neither of them
// need exist. Devices and pipes are no files.
bool is_same_file(const std::string& path, const std::string& other);

class OutputFile {
public:
    explicit OutputFile(const std::string& path);
    ~OutputFile();  // without a commit(): removes what was written

    std::ostream& stream() { return stream_; }
    void finish();  // everything has been written, or a Failure
    void commit();  // finish, and take the place of an older file of that name

private:
    [[noreturn]] void fail() const;

    std::string path_, temporary_;  // temporary_ empty: nothing to remove
    std::ofstream stream_;
};

// The files of one command: either all of them appear, or none.
class OutputFiles {
public:
    std::ostream& add(const std::string& path) { return files_.emplace_back(path).stream(); }
    void commit();

private:
    std::deque<OutputFile> files_;
};

}  // namespace cli
