// Output files that appear whole or not at all: they are written under temporary names beside their
// places, and renamed by commit(). An output that replaces a file keeps the permissions of the
// file, and its owner and group where the system allows that; a symbolic link stays a link, and the
// file that it leads to is replaced.
#pragma once

#include <deque>
#include <filesystem>
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
    ~OutputFile();  // removes what has no place yet
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    std::ostream& stream() { return stream_; }
    void finish();  // everything has been written, or a Failure

    // Takes the place of an older file of that name. A copy of the older file stays until keep() if
    // undo() may be called.
    void replace(bool may_be_undone);
    void undo() noexcept;
    void keep() noexcept;

private:
    [[noreturn]] void fail() const;
    void create_privately() const;

    std::string path_, temporary_, older_;  // empty: there is no such file to remove
    bool has_replaced_ = false;
    std::filesystem::file_status before_;  // of the file that is replaced
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
