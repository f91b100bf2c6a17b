#include "files/own_folder.hpp"

#include "basics/failure.hpp"
#include "files/paths.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#ifndef _WIN32
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

namespace cli {

namespace {

namespace fs = std::filesystem;

}  // namespace

OwnFolder::OwnFolder(const std::string& path, const std::string& sign)
    : path_(path), lock_(path + "/" + sign + ".lock") {
    make_folders(path_);
    refuse_others(sign);
    lock();
    try {
        refuse_others(sign);  // another run may have filled the folder meanwhile
    } catch (const Failure&) {
        unlock();
        throw;
    }
}

// What a run left that ended before it wrote the sign does not count: the lock, and the sign under
// a temporary name.
void OwnFolder::refuse_others(const std::string& sign) const {
    std::error_code error;
    if (fs::exists(path_ + "/" + sign, error)) return;
    for (const fs::directory_entry& entry : fs::directory_iterator(path_, error)) {
        const std::string name = entry.path().filename().string();
        if (name == sign + ".lock" || name.compare(0, sign.size() + 5, sign + ".part") == 0)
            continue;
        throw Failure(exit_usage, path_ + " is not empty and has no " + sign +
                                      " of an earlier run, so its files are kept: name a new or "
                                      "an empty folder");
    }
    if (error) throw Failure(exit_file, path_ + ": cannot be read: " + error.message());
}

#ifndef _WIN32

// The owner of the lock removes its file, so the file that was opened may be another one than that
// of the name by the time it is locked: then the lock is taken again.
void OwnFolder::lock() {
    constexpr mode_t all_may_write = 0666;  // less what the umask takes
    for (;;) {
        descriptor_ = open(lock_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, all_may_write);
        if (descriptor_ < 0)
            throw Failure(exit_file, lock_ + ": cannot be written: " + std::strerror(errno));
        if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
            const int reason = errno;
            close(descriptor_);
            if (reason != EWOULDBLOCK)
                throw Failure(exit_file, lock_ + ": cannot be locked: " + std::strerror(reason));
            throw Failure(exit_usage, path_ +
                                          " is being filled by another run of harmorph: wait "
                                          "for its end, or name another folder");
        }
        struct stat opened, named;
        const bool is_same = fstat(descriptor_, &opened) == 0 && stat(lock_.c_str(), &named) == 0 &&
                             opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
        if (is_same) return;
        close(descriptor_);
    }
}

void OwnFolder::unlock() noexcept {
    if (descriptor_ < 0) return;
    unlink(lock_.c_str());
    close(descriptor_);
    descriptor_ = -1;
}

#else

void OwnFolder::lock() {}
void OwnFolder::unlock() noexcept {}

#endif

OwnFolder::~OwnFolder() { unlock(); }

}  // namespace cli
