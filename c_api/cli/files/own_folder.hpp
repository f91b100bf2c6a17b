// A folder that one command fills with many files. The command owns the folder if the folder is
// new or empty, or contains the file by which the command recognises its own folders. While the
// object exists, no other run of the program can open the folder; the lock ends with the process,
// however the process ends.
#pragma once

#include <string>

namespace cli {

class OwnFolder {
public:
    // sign: the name of the file by which the command recognises the folder. The command writes
    // this file before all others. Makes the folder if it does not exist.
    OwnFolder(const std::string& path, const std::string& sign);
    ~OwnFolder();
    OwnFolder(const OwnFolder&) = delete;
    OwnFolder& operator=(const OwnFolder&) = delete;

private:
    void refuse_others(const std::string& sign) const;
    void lock();
    void unlock() noexcept;

    std::string path_, lock_;
    int descriptor_ = -1;
};

}  // namespace cli
