// Calls of the library: a refusal becomes a failure of the program that names the file and, if
// possible, the line.
#pragma once

#include "basics/failure.hpp"
#include "basics/print.hpp"

#include <harmorph.h>
#include <harmorph_pages.h>

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <string>

namespace cli {

// Memory for an object of the library, in huge pages where the system has them. The memory is not
// filled: pages cost nothing until the library touches them.
class Block {
public:
    Block() = default;
    explicit Block(std::size_t bytes) { resize(bytes); }
    void resize(std::size_t bytes);  // keeps memory that is large enough, but not its contents
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

// An options or report struct with its size set and all other members 0.
template <class Struct>
Struct sized() {
    Struct result = {};
    result.struct_size = sizeof result;
    return result;
}

ExitCode exit_code(hm_status status);  // of a program that ends with this error
// Throws a Failure for an error of the library. `path` is the file that causes the error;
// mesh/mesh_file.hpp has the same function for an error about a mesh.
[[noreturn]] void refuse(const hm_error& error, const std::string& path);

// Makes a call that takes memory: make(&memory) first asks for the size, and is made again with the
// block. Returns the status of the last of the two.
template <class Make>
hm_status with_memory(Block& block, const Make& make) {
    hm_memory memory = {};
    const hm_status status = make(&memory);
    if (status < 0) return status;
    block.resize(memory.bytes);
    memory.block = block.data();
    return make(&memory);
}

// Calls a function of the library with its arguments, to which the hm_error is added. Returns the
// status, which is 0 or a warning. A refusal is about `about`, a path or a mesh.
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
