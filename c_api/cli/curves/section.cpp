#include "curves/section.hpp"

#include "basics/elementary.hpp"
#include "basics/failure.hpp"
#include "basics/library.hpp"
#include "basics/numbers.hpp"
#include "curves/section_checks.hpp"

#include <harmorph_design.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <ostream>

namespace cli {

// Finds the outlines in the blocks of a file: one run round the section, two sides, or elements.

namespace {

constexpr double equal_points = 1e-12;  // [extent] consecutive points this near are one point
// [extent] The ends of the outline of an element are nearer than this; those of a side are not.
constexpr double widest_base = .75;
constexpr double same_end = .2;  // [extent] sides that begin as near as this begin together

double gap_between(const SectionPoint& a, const SectionPoint& b) {
    return length_of(b.x - a.x, b.y - a.y);
}

SectionOutline without_repeats(const SectionOutline& points) {
    const double near = equal_points * extent_of(points);
    SectionOutline kept;
    for (const SectionPoint& point : points)
        if (kept.empty() || gap_between(kept.back(), point) > near) kept.push_back(point);
    while (kept.size() > 1 && gap_between(kept.front(), kept.back()) <= near) kept.pop_back();
    return kept;
}

SectionOutline joined_points(SectionOutline first, const SectionOutline& second) {
    first.insert(first.end(), second.begin(), second.end());
    return first;
}

bool has_closed_ends(const SectionOutline& block) {
    return block.size() > 4 &&
           gap_between(block.front(), block.back()) < widest_base * extent_of(block);
}

// Both sides begin at the same end of the section, and end at the other end.
bool begin_together(const SectionOutline& a, const SectionOutline& b) {
    if (a.size() < 2 || b.size() < 2 || has_closed_ends(a) || has_closed_ends(b)) return false;
    const double near = same_end * extent_of(joined_points(a, b));
    return gap_between(a.front(), b.front()) < near &&
           gap_between(a.front(), b.front()) + gap_between(a.back(), b.back()) <
               gap_between(a.back(), b.front()) + gap_between(a.front(), b.back());
}

// Makes a loop of two sides that begin together, from the end with the wider gap, or with the
// larger x.
SectionOutline loop_of_sides(SectionOutline a, SectionOutline b) {
    const double first = gap_between(a.front(), b.front()), last = gap_between(a.back(), b.back());
    const bool from_leading_edge = first != last ? first < last : a.front().x < a.back().x;
    SectionOutline& backwards = from_leading_edge ? a : b;
    std::reverse(backwards.begin(), backwards.end());
    return joined_points(std::move(a), b);
}

struct FoundSection {
    SectionOutline outline;
    std::string layout;
};

class SectionReader {
public:
    explicit SectionReader(const TextFile& file) : file_(file), table_(read_section_table(file)) {}

    std::vector<Section> read() {
        take_counts();
        std::vector<FoundSection> found;
        for (auto block = table_.blocks.begin(); block != table_.blocks.end();) {
            const auto end = std::find_if(
                block, table_.blocks.end(),
                [&](const SectionBlock& other) { return other.element != block->element; });
            std::vector<SectionOutline> pieces;
            for (; block != end; ++block) pieces.push_back(block->points);
            for (FoundSection& one : outlines_in(std::move(pieces)))
                found.push_back(std::move(one));
        }
        std::vector<Section> sections;
        for (FoundSection& one : found)
            sections.push_back(section_of(std::move(one), found.size()));
        return sections;
    }

private:
    // The first line of numbers of a file with two columns may have the numbers of points of both
    // sides, or be a title such as "63 412". With other columns, such a line is in table_.counts.
    void take_counts() {
        if (table_.blocks.empty())
            file_.fail(file_.text().size(), "the file has no points between its separator lines");
        points_ = 0;
        for (const SectionBlock& block : table_.blocks) points_ += block.points.size();
        if (table_.counts.size() == 2) return use_counts(table_.counts[0], table_.counts[1], 0);
        const SectionPoint first = table_.blocks[0].points[0];
        const bool is_whole = std::floor(first.x) == first.x && std::floor(first.y) == first.y;
        if (!is_whole || first.x < 2 || first.y < 2) return;
        const bool are_counts = first.x + first.y == static_cast<double>(points_ - 1);
        if (!are_counts && !stands_apart()) return;
        table_.blocks[0].points.erase(table_.blocks[0].points.begin());
        if (table_.blocks[0].points.empty()) table_.blocks.erase(table_.blocks.begin());
        --points_;
        use_counts(first.x, first.y, first.offset);
        if (table_.blocks.empty())
            file_.fail(first.offset, "no points follow the counts of points");
    }

    // Tells whether the first point is farther from all others than these are from each other.
    bool stands_apart() const {
        SectionOutline all;
        for (const SectionBlock& block : table_.blocks)
            all = joined_points(std::move(all), block.points);
        if (all.size() < 4) return true;
        if (stray_point(all) == 0) return true;
        const SectionOutline others(all.begin() + 1, all.end());
        const double extent = extent_of(others);
        return std::all_of(others.begin(), others.end(), [&](const SectionPoint& point) {
            return gap_between(point, all[0]) > extent;
        });
    }

    void use_counts(double upper, double lower, std::size_t offset) {
        counts_offset_ = offset;
        upper_ = upper;
        lower_ = lower;
        has_counts_ = true;
    }

    // A number of points was lost or is wrong; a title is far from the number of points.
    bool counts_nearly_agree() const {
        const auto n = static_cast<double>(points_);
        return has_counts_ && std::fabs(upper_ + lower_ - n) <= std::max(2.0, .1 * n);
    }

    bool counts_agree() const {
        return has_counts_ && upper_ + lower_ == static_cast<double>(points_);
    }

    std::vector<FoundSection> outlines_in(std::vector<SectionOutline> pieces) {
        drop_reference_point(pieces);
        SectionOutline all;
        for (const SectionOutline& piece : pieces) all = joined_points(std::move(all), piece);
        if (counts_agree()) return {sides_with_counts(all)};
        if (pieces.size() > 1 && std::all_of(pieces.begin(), pieces.end(), has_closed_ends)) {
            std::vector<FoundSection> elements;
            for (SectionOutline& piece : pieces) elements.push_back({std::move(piece), "one run"});
            return elements;
        }
        FoundSection sides;
        if (pieces.size() == 2 && begin_together(pieces[0], pieces[1]))
            sides = {loop_of_sides(pieces[0], pieces[1]), "two sides without counts"};
        else if (pieces.size() != 2) sides = sides_in(all);
        if (sides.outline.empty() && !counts_nearly_agree()) {
            if (has_counts_) add_property("a title of two numbers");
            return {{std::move(all), "one run"}};
        }
        if (has_counts_) {
            file_.fail(counts_offset_, "the file says " + brief(upper_) + " and " + brief(lower_) +
                                           " points of the two sides, but " +
                                           plural(std::int64_t(points_), "point") + " follow");
        }
        return {sides};
    }

    void add_property(const char* property) {
        auto& all = table_.properties;
        if (std::find(all.begin(), all.end(), property) == all.end()) all.push_back(property);
    }

    // OpenFAST's files, and files with a count that includes it, begin with a reference point.
    void drop_reference_point(std::vector<SectionOutline>& pieces) {
        const bool may_have_one =
            table_.is_openfast ||
            (table_.counts.size() == 1 && table_.counts[0] == static_cast<double>(points_));
        if (!may_have_one || pieces.empty()) return;
        SectionOutline all;
        for (const SectionOutline& piece : pieces) all = joined_points(std::move(all), piece);
        const bool alone = table_.is_openfast && pieces.size() > 1 && pieces[0].size() == 1;
        if (!alone && stray_point(all) != 0) return;
        pieces[0].erase(pieces[0].begin());
        if (pieces[0].empty()) pieces.erase(pieces.begin());
        add_property("a reference point before the outline");
    }

    FoundSection sides_with_counts(const SectionOutline& all) const {
        const auto middle = all.begin() + static_cast<std::ptrdiff_t>(upper_);
        SectionOutline upper(std::make_reverse_iterator(middle), all.rend());
        return {joined_points(std::move(upper), {middle, all.end()}),
                "two sides with counts (Lednicer)"};
    }

    // The longest segment of one list of both sides goes from the end of a side to the beginning of
    // the other one.
    static FoundSection sides_in(const SectionOutline& all) {
        std::size_t longest = 0;
        for (std::size_t k = 0; k + 1 < all.size(); ++k)
            if (gap_between(all[k], all[k + 1]) > gap_between(all[longest], all[longest + 1]))
                longest = k;
        if (all.size() < 6 || !(gap_between(all[longest], all[longest + 1]) > .5 * extent_of(all)))
            return {};
        const auto middle = all.begin() + static_cast<std::ptrdiff_t>(longest) + 1;
        const SectionOutline a(all.begin(), middle), b(middle, all.end());
        if (!begin_together(a, b)) return {};
        return {loop_of_sides(a, b), "two sides without counts"};
    }

    Section section_of(FoundSection&& found, std::size_t elements) {
        const SectionOutline outline = without_repeats(found.outline);
        const std::string name =
            elements > 1 ? "element " + std::to_string(++element_) + ": " : std::string();
        if (outline.size() < 3) {
            file_.fail(found.outline.back().offset,
                       name + "the section has only " +
                           plural(std::int64_t(outline.size()), "point") +
                           "; 3 are needed at least");
        }
        SectionFindings findings = check_section(file_, outline);
        if (!findings.refusal.empty())
            file_.fail(outline[findings.at].offset, name + findings.refusal);
        Section section;
        for (const SectionPoint& point : outline) {
            section.x.push_back(point.x);
            section.y.push_back(point.y);
        }
        section.layout = found.layout;
        section.layout += area_of(outline) > 0 ? ", counter-clockwise" : ", clockwise";
        for (const std::string& property : table_.properties) section.layout += ", " + property;
        for (std::string& warning : findings.warnings)
            section.warnings.push_back(file_.path() + ": " + name + warning);
        return section;
    }

    const TextFile& file_;
    SectionTable table_;
    std::size_t points_ = 0, counts_offset_ = 0;
    double upper_ = 0, lower_ = 0;
    bool has_counts_ = false;
    int element_ = 0;
};

}  // namespace

std::vector<Section> read_sections(const std::string& path) {
    const TextFile file(path);
    return SectionReader(file).read();
}

Section read_section(const std::string& path, std::int32_t element) {
    std::vector<Section> all = read_sections(path);
    const auto n = static_cast<std::int32_t>(all.size());
    if (element == 0 && n == 1) return std::move(all[0]);
    if (element >= 1 && element <= n) return std::move(all[static_cast<std::size_t>(element) - 1]);
    throw Failure(exit_file,
                  path + ": the file has " + plural(n, "element") +
                      (element == 0 ? "; --element K (from 1) chooses one"
                                    : ", and none with the number " + std::to_string(element)));
}

bool is_section_file(const TextFile& file) { return looks_like_section(file); }

namespace {

double area_inside(const Section& section) {
    double sum = 0;
    for (std::size_t k = 0; k < section.x.size(); ++k) {
        const std::size_t next = (k + 1) % section.x.size();
        sum += section.x[k] * section.y[next] - section.x[next] * section.y[k];
    }
    return sum / 2;
}

}  // namespace

Section sampled(const Curves& curves) {
    constexpr int points_per_span = 10;
    const CurvesView view(curves);
    const Curve& curve = curves.curves.front();
    const auto degree = static_cast<std::size_t>(curve.degree);
    Section section;
    const auto add = [&](double u) {
        double xy[2] = {0, 0};
        call("curve", hm_curve_point, view.get(), std::int32_t{0}, u, std::int32_t{0}, xy);
        section.x.push_back(xy[0]);
        section.y.push_back(xy[1]);
    };
    const std::size_t last = curve.knots.size() - 1 - degree;
    for (std::size_t k = degree; k < last; ++k) {
        const double begin = curve.knots[k], end = curve.knots[k + 1];
        for (int i = 0; end > begin && i < points_per_span; ++i)
            add(begin + (end - begin) * i / points_per_span);
    }
    if (curve.closed == HM_OPEN) add(curve.knots[last]);
    // If there is a second curve, it is the base, which closes the section.
    section.is_loop = curve.closed != HM_OPEN || curves.curves.size() > 1;
    return section;
}

void write_selig(std::ostream& out, const Curves& curves) {
    Section section = sampled(curves);
    std::size_t n = section.x.size();
    if (curves.curves.front().closed == HM_PERIODIC) {
        const auto first = std::max_element(section.x.begin(), section.x.end()) - section.x.begin();
        std::rotate(section.x.begin(), section.x.begin() + first, section.x.end());
        std::rotate(section.y.begin(), section.y.begin() + first, section.y.end());
    }
    if (curves.curves.front().closed != HM_OPEN) {  // closed sections repeat the first point
        section.x.push_back(section.x[0]);
        section.y.push_back(section.y[0]);
        ++n;
    }
    const bool clockwise = area_inside(section) < 0;
    out << "harmorph\n";
    for (std::size_t k = 0; k < n; ++k) {
        const std::size_t point = clockwise ? n - 1 - k : k;
        out << exact(section.x[point]) << ' ' << exact(section.y[point]) << '\n';
    }
}

}  // namespace cli
