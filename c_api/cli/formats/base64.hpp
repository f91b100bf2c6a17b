// Converts bytes to text of 64 characters (RFC 4648) and back, as XML files need.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace cli {

// Decodes the text from `at` on, and appends n bytes or up to two more to `to`. `at` becomes the
// place after the last group of four characters that was decoded. Blanks are skipped, and several
// texts, each with its padding (=), may follow each other. Returns false if another character is
// found, or the text ends before n bytes.
bool decode_base64(std::string_view text, std::size_t& at, std::size_t n, std::string& to);

std::string encode_base64(std::string_view bytes);

}  // namespace cli
