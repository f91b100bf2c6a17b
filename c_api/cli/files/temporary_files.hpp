// Names of files that are being written. A signal that ends the program (interruption, termination,
// hang-up, a closed pipe, exceeded limits) removes these files first; a signal that the caller of
// the program ignores stays ignored.
#pragma once

#include <string>

namespace cli {

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

}  // namespace cli
