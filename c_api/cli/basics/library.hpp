// Calls of the library: refusals become failures of the program that say which file, and if
// possible which line, is meant.
#pragma once

#include "commands/commands.hpp"
#include "harmorph_pages.h"
#include "mesh/mesh_file.hpp"

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <string>

namespace cli {

// Memory for an object of the library, in huge pages where the system has them. It is not filled:
// untouched pages cost nothing until the library needs them.
class Block {
public:
    Block() = default;
    explicit Block(std::size_t bytes) { resize(bytes); }
    void resize(
        std::size_t bytes);  // keeps the memory where it is large enough, but not what is in it
    unsigned char* data() { return data_; }
    const unsigned char* data() const { return data_; }
    std::size_t size() const { return size_; }

private:
    struct Free {
        void operator()(void* memory) const { std::free(memory); }
    };
    std::unique_ptr<void, Free> memory_;
    unsigned char* data_ = nullptr;  // inside memory_, where huge pages begin
    std::size_t size_ = 0, capacity_ = 0;
};

// An options or report struct as the library wants it: its size, and 0.
template <class Struct>
Struct sized() {
    Struct result = {};
    result.struct_size = sizeof result;
    return result;
}

[[noreturn]] void refuse(const hm_error& error,
                         const std::string& path);  // path: the file that is at fault
[[noreturn]] void refuse(const hm_error& error, const Mesh& mesh);

// call(about, hm_function, arguments without the hm_error) returns the status, 0 or a warning.
template <class About, class Function, class... Arguments>
hm_status call(const About& about, Function function, Arguments... arguments) {
    hm_error error = {};
    const hm_status status = function(arguments..., &error);
    if (status < 0) refuse(error, about);
    if (status == HM_FAR_FROM_CURVE)
        warn(error.text);  // other warnings are about results, which the caller looks at
    return status;
}

}  // namespace cli
