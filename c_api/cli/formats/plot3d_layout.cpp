#include "formats/plot3d_layout.hpp"

#include "basics/numbers.hpp"
#include "formats/bytes.hpp"
#include "formats/number_reader.hpp"

#include <algorithm>

namespace cli {

namespace {

constexpr std::int64_t max_blocks = 1 << 20;
constexpr int word_bytes = 4;  // bytes of a whole number in binary files

std::string sizes(const Plot3dLayout& layout) {
    std::string text = plural(static_cast<std::int64_t>(layout.blocks.size()), "block");
    if (layout.blocks.size() > 1) text += ", the first of";
    for (int d = 0; d < layout.dimensions; ++d) {
        text += (d == 0 ? " " : " x ") +
                std::to_string(layout.blocks[0].n[static_cast<std::size_t>(d)]);
    }
    return text;
}

// Returns the number of values of a block in the file.
std::int64_t numbers_of(const Plot3dLayout& layout, const Plot3dBlock& block) {
    return block.points() * (layout.dimensions + (layout.has_iblank ? 1 : 0));
}

// Tells whether the sizes are plausible; products of plausible sizes do not overflow.
bool plausible(const Plot3dBlock& block, std::int64_t max_points) {
    std::int64_t points = 1;
    for (const std::int64_t n : block.n) {
        if (n < 1 || n > max_points / points) return false;
        points *= n;
    }
    return true;
}

// ---- Text ----

class TextLayouts {
public:
    explicit TextLayouts(const TextFile& file) {
        NumberReader numbers(file);
        std::int64_t value = 0;
        // Numbers that could be sizes are kept; the others are counted.
        while (parse(numbers.word(), value)) {
            if (whole_.size() < 3 * max_blocks) whole_.push_back(value);
            end_of_whole_.push_back(numbers.offset());
            if (whole_.size() == 1 && (value < 1 || value > INT32_MAX)) return;
        }
        if (whole_.size() < 2) return;
        total_ = static_cast<std::int64_t>(end_of_whole_.size());
        const std::string_view text = file.text();
        numbers.jump(end_of_whole_.back());
        bool in_word = false;
        for (std::size_t i = end_of_whole_.back(); i < text.size(); ++i) {
            const bool blank =
                text[i] == ' ' || (text[i] >= '\t' && text[i] <= '\r') || text[i] == ',';
            if (!blank && !in_word) ++total_;
            in_word = !blank;
            if (text[i] == '\0') total_ = INT64_MIN;  // binary
        }
    }

    bool fits(Plot3dLayout& layout, std::string& reason) const {
        if (total_ <= 0) return false;
        const std::int64_t n_blocks = layout.has_count ? whole_[0] : 1;
        const std::int64_t first = layout.has_count ? 1 : 0,
                           n_sizes = first + n_blocks * layout.dimensions;
        if (n_blocks < 1 || n_blocks > max_blocks ||
            n_sizes > static_cast<std::int64_t>(whole_.size()))
            return false;
        layout.blocks.clear();
        std::int64_t wanted = n_sizes;
        for (std::int64_t at = first; at < n_sizes; at += layout.dimensions) {
            Plot3dBlock block = {{1, 1, 1}, 0};
            for (int d = 0; d < layout.dimensions; ++d) {
                block.n[static_cast<std::size_t>(d)] = whole_[static_cast<std::size_t>(at + d)];
            }
            if (!plausible(block, 1 << 30)) return false;
            layout.blocks.push_back(block);
            wanted += numbers_of(layout, block);
            if (wanted > INT64_MAX / 2) return false;
        }
        layout.data = end_of_whole_[static_cast<std::size_t>(n_sizes) - 1];
        if (wanted == total_) return true;
        if (reason.empty() && layout.has_count == (whole_[0] == 1)) {
            reason = "with " + sizes(layout) + " the file would have " + std::to_string(wanted) +
                     " numbers, but it has " + std::to_string(total_);
        }
        return false;
    }

private:
    std::vector<std::int64_t> whole_;
    std::vector<std::size_t> end_of_whole_;
    std::int64_t total_ = 0;
};

// ---- Binary ----

class BinaryLayout {
public:
    BinaryLayout(const TextFile& file, Plot3dLayout& layout)
        : text_(file.text()), layout_(layout) {}

    bool fits(std::string& reason) {
        std::int64_t n_blocks = 1;
        if (layout_.has_count && !(open(word_bytes) && take(n_blocks) && close())) return false;
        if (n_blocks < 1 || n_blocks > max_blocks) return false;
        if (!open(n_blocks * layout_.dimensions * word_bytes)) return false;
        layout_.blocks.clear();
        for (std::int64_t block = 0; block < n_blocks; ++block) {
            layout_.blocks.push_back({{1, 1, 1}, 0});
            for (int d = 0; d < layout_.dimensions; ++d) {
                if (!take(layout_.blocks.back().n[static_cast<std::size_t>(d)])) return false;
            }
            if (!plausible(layout_.blocks.back(), std::int64_t{1} << 40)) return false;
        }
        if (!close()) return false;
        for (std::size_t block = 0; block < layout_.blocks.size(); ++block) {
            const std::int64_t points = layout_.blocks[block].points();
            const std::int64_t bytes = points * (layout_.dimensions * layout_.real_bytes +
                                                 (layout_.has_iblank ? word_bytes : 0));
            const std::size_t begin = at_;
            const bool opened = open(bytes);
            layout_.blocks[block].data = at_;
            const bool there = opened && bytes <= left();
            if (there) at_ += static_cast<std::size_t>(bytes);
            if (there && close()) continue;
            // The length of the record agrees with the layout, so the file is damaged.
            if (layout_.record_bytes > 0 && opened) {
                reason = "byte " + std::to_string(begin) + ": the record of block " +
                         std::to_string(block + 1) + " (" + sizes(layout_) + ") has " +
                         std::to_string(bytes) + " bytes, but " +
                         (there ? "another length after it"
                                : "the file ends after " + std::to_string(left()));
            }
            return false;
        }
        return at_ == text_.size();
    }

private:
    std::int64_t left() const { return static_cast<std::int64_t>(text_.size() - at_); }

    bool take(std::int64_t& value) {
        if (left() < word_bytes) return false;
        value = load<std::int32_t>(text_.data() + at_, layout_.swapped);
        at_ += word_bytes;
        return true;
    }
    // Reads the length before a record, which close() compares with the length after the record.
    bool open(std::int64_t bytes) {
        length_ = bytes;
        return close();
    }
    bool close() {
        if (layout_.record_bytes == 0) return true;
        if (left() < layout_.record_bytes) return false;
        const char* const at = text_.data() + at_;
        const bool four = layout_.record_bytes == 4;
        const std::int64_t length = four ? load<std::uint32_t>(at, layout_.swapped)
                                         : load<std::int64_t>(at, layout_.swapped);
        at_ += static_cast<std::size_t>(layout_.record_bytes);
        return length == length_;
    }

    std::string_view text_;
    Plot3dLayout& layout_;
    std::size_t at_ = 0;
    std::int64_t length_ = 0;
};

template <class Try>
bool any_of_all(Plot3dLayout& layout, Try fits) {
    for (const bool has_count : {true, false}) {
        for (const int dimensions : {2, 3}) {
            for (const bool has_iblank : {false, true}) {
                layout.has_count = has_count;
                layout.dimensions = dimensions;
                layout.has_iblank = has_iblank;
                if (fits()) return true;
            }
        }
    }
    return false;
}

}  // namespace

bool find_plot3d_layout(const TextFile& file, Plot3dLayout& layout, std::string& reason) {
    layout.is_text = false;
    for (const int record_bytes : {4, 8, 0}) {
        for (const bool swapped : {false, true}) {
            for (const int real_bytes : {8, 4}) {
                layout.record_bytes = record_bytes;
                layout.swapped = swapped;
                layout.real_bytes = real_bytes;
                if (any_of_all(layout, [&] { return BinaryLayout(file, layout).fits(reason); }))
                    return true;
            }
        }
    }
    layout.is_text = true;
    layout.swapped = false;
    const TextLayouts text(file);
    return any_of_all(layout, [&] { return text.fits(layout, reason); });
}

}  // namespace cli
