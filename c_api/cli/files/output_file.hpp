// Output files that appear whole or not at all: they are written under temporary names beside their
// places, and renamed by commit(). An output that replaces a file keeps the permissions of the
// file, and its owner and group where the system allows that; a symbolic link stays a link, and the
// file that it leads to is replaced.
#pragma once

#include <deque>
#include <fstream>
#include <optional>
#include <string>

namespace cli {

// Names of files that are being written. A signal that ends the program (interruption, termination,
// hang-up, a closed pipe, exceeded limits) removes these files first; a signal that the caller of
// the program ignores stays ignored.

void remember_temporary(const std::string& path);  // to be called before the file exists
void forget_temporary(const std::string& path);    // to be called when the file has been renamed

// Removes these files; a handler of a signal may call this function.
void remove_temporaries();

// While this object exists, these signals wait.
class SignalsWait {
public:
    SignalsWait();
    ~SignalsWait();
    SignalsWait(const SignalsWait&) = delete;
    SignalsWait& operator=(const SignalsWait&) = delete;
};

// Returns whether the path is a device or a pipe: the program writes to it directly, and writes no
// other files beside it.
bool is_device(const std::string& path);

// Returns whether both paths lead to one file, by symbolic or hard links or another spelling. The
// file need not exist. Devices and pipes do not count as files.
bool is_same_file(const std::string& path, const std::string& other);

class OutputFile {
public:
    explicit OutputFile(const std::string& path);
    ~OutputFile();  // removes a file that still has the temporary name
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    std::ostream& stream() { return stream_; }
    const std::string& path() const { return path_; }
    void finish();  // throws a Failure if not everything has been written

    // Gives the file its final name, in place of an older file of that name. If undo() may be
    // called, the older file is kept under another name until keep().
    void replace(bool may_be_undone);
    void undo() noexcept;
    void keep() noexcept;

private:
    [[noreturn]] void fail() const;
    [[noreturn]] void fail_to_write();
    void create_privately() const;

    std::string path_, temporary_, older_;  // empty: there is no such file to remove
    bool has_replaced_ = false;
    std::optional<unsigned> permissions_;  // of the file that is replaced, if there is one
    std::ofstream stream_;
};

// The files of one command: either all of them appear, or none.
class OutputFiles {
public:
    std::ostream& add(const std::string& path);  // refuses a file that it has already
    void commit();

private:
    std::deque<OutputFile> files_;
};

// Tells whether this process has put a file in its place.
bool has_written_files();

}  // namespace cli
