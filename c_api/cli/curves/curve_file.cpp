#include "curves/curve_file.hpp"

#include "basics/library.hpp"
#include "basics/numbers.hpp"
#include "curves/cad_curves.hpp"
#include "curves/section.hpp"

#include <harmorph_design.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <ostream>
#include <utility>

namespace cli {

namespace {

class CurveReader {
public:
    explicit CurveReader(TextFile&& file) : file_(std::move(file)), lines_(file_, '#') {}
    Curves read();

private:
    void read_keyword();
    void read_degree();
    void read_closed();
    void read_points();
    void read_knots();
    void read_indices();
    bool repeats_first_points() const;
    [[noreturn]] void refuse_repeated_points() const;
    void drop_repeated_points();
    void read_weights();
    void finish_curve();

    std::int32_t count(const char* keyword, std::int32_t smallest);
    template <class Number>
    std::vector<Number> numbers(std::int32_t n, const char* what);
    template <class Number>
    Number number(std::string_view word, const char* what) const;
    void refuse_repeated(bool is_there) const;
    void require_points() const;

    TextFile file_;
    LineReader lines_;
    Curves curves_;
    Curve curve_;  // the curve that is being read
    bool has_closed_ = false;
    std::size_t knots_offset_ = 0, indices_offset_ = 0;
};

Curves CurveReader::read() {
    while (lines_.next()) read_keyword();
    finish_curve();
    call(file_.path(), hm_curves_check, CurvesView(curves_).get());
    return std::move(curves_);
}

void CurveReader::read_keyword() {
    const std::string_view keyword = lines_.words()[0];
    if (keyword == "degree") return read_degree();
    if (keyword == "closed") return read_closed();
    if (keyword == "points") return read_points();
    if (keyword == "knots") return read_knots();
    if (keyword == "indices") return read_indices();
    if (keyword == "weights") return read_weights();
    if (keyword != "curve")
        lines_.expected("degree, closed, points, knots, indices, weights or curve");
    finish_curve();
}

void CurveReader::read_degree() {
    refuse_repeated(curve_.degree != 0);
    curve_.degree = count("degree", 1);
    if (curve_.degree > 5) lines_.expected("a degree between 1 and 5");
}

void CurveReader::read_closed() {
    refuse_repeated(has_closed_);
    const auto& words = lines_.words();
    for (const std::int32_t closed : {HM_OPEN, HM_TIED, HM_PERIODIC}) {
        if (words.size() == 2 && words[1] == closed_name(closed)) {
            curve_.closed = closed;
            has_closed_ = true;
        }
    }
    if (!has_closed_) lines_.expected("closed periodic, closed tied or closed open");
}

void CurveReader::read_points() {
    if (!curves_.control.empty())
        lines_.fail("this is a second list of points; all curves use the points of the first list");
    const std::int32_t n = count("points", 2);
    for (std::int32_t point = 0; point < n; ++point) {
        const bool found = lines_.next();
        const auto& words = lines_.words();
        if (!found || words.size() != 2) {
            lines_.expected("x and y of point " + std::to_string(point + 1) + " of " +
                            std::to_string(n));
        }
        for (const std::string_view word : words)
            curves_.control.push_back(number<double>(word, "a finite number"));
    }
}

void CurveReader::read_knots() {
    refuse_repeated(!curve_.knots.empty());
    const std::int32_t n = count("knots", 4);
    knots_offset_ = lines_.offset();
    curve_.knots = numbers<double>(n, "knot");
}

void CurveReader::read_indices() {
    refuse_repeated(!curve_.indices.empty());
    require_points();
    const std::int32_t n = count("indices", 2);
    indices_offset_ = lines_.offset();
    curve_.indices = numbers<std::int32_t>(n, "index");
    for (std::int32_t& index : curve_.indices) {
        if (index < 1 || index > curves_.points()) {
            const std::string last = std::to_string(curves_.points());
            file_.fail(indices_offset_, "the file needs indices between 1 and " + last +
                                            " here, but " + std::to_string(index) + " follows");
        }
        --index;
    }
}

void CurveReader::read_weights() {
    refuse_repeated(!curves_.weights.empty());
    require_points();
    const std::int32_t n = count("weights", 2);
    if (n != curves_.points())
        lines_.expected("weights " + std::to_string(curves_.points()) + ", one for each point");
    const std::size_t offset = lines_.offset();
    curves_.weights = numbers<double>(n, "weight");
    for (const double weight : curves_.weights) {
        if (weight <= 0)
            file_.fail(offset,
                       "the file needs weights above 0 here, but " + brief(weight) + " follows");
    }
}

void CurveReader::finish_curve() {
    if (curve_.degree == 0) lines_.expected("degree");
    if (!has_closed_) lines_.expected("closed");
    require_points();
    if (curve_.knots.empty()) lines_.expected("knots");
    if (curve_.indices.empty() && repeats_first_points()) {
        const std::int32_t repeated = curve_.degree;
        curve_.indices = default_indices(curves_.points() - repeated, repeated, HM_PERIODIC);
        if (curve_.closed == HM_OPEN) refuse_repeated_points();
        drop_repeated_points();
    } else if (curve_.indices.empty()) {
        curve_.indices = default_indices(curves_.points(), curve_.degree, curve_.closed);
    } else if (!closes(curve_)) {
        const std::string how = closed_name(curve_.closed);
        file_.fail(indices_offset_,
                   "these indices do not make the curve closed " + how + " as the file says");
    }
    const std::size_t n_knots = curve_.indices.size() + static_cast<std::size_t>(curve_.degree) + 1;
    if (curve_.knots.size() != n_knots) {
        file_.fail(knots_offset_,
                   "the curve needs " + std::to_string(n_knots) + " knots (" +
                       plural(static_cast<std::int64_t>(curve_.indices.size()), "control point") +
                       " with repeats, degree " + std::to_string(curve_.degree) + "), but has " +
                       std::to_string(curve_.knots.size()));
    }
    curves_.curves.push_back(std::exchange(curve_, Curve()));
    has_closed_ = false;
}

// Tells whether the last points, as many as the degree, are the first ones again, as in the usual
// notation of periodic curves, which has one knot more than these points and the degree.
bool CurveReader::repeats_first_points() const {
    const auto n = static_cast<std::size_t>(curves_.points()),
               repeated = static_cast<std::size_t>(curve_.degree);
    const bool is_alone = curves_.curves.empty() && curve_.knots.size() == n + repeated + 1;
    if (curve_.closed == HM_TIED || n <= 2 * repeated || !is_alone) return false;
    if (!(curve_.knots[0] < curve_.knots[repeated])) return false;  // clamped at the first point
    const auto [low, high] = std::minmax_element(curves_.control.begin(), curves_.control.end());
    const double rounding = 1e-12 * (*high - *low);
    for (std::size_t k = 0; k < 2 * repeated; ++k) {
        const double last = curves_.control[2 * (n - repeated) + k];
        if (!(std::fabs(last - curves_.control[k]) <= rounding)) return false;
    }
    const std::vector<double>& weights = curves_.weights;
    return weights.empty() || std::equal(weights.begin(), weights.begin() + curve_.degree,
                                         weights.end() - curve_.degree);
}

void CurveReader::refuse_repeated_points() const {
    std::string lines = "\nindices " + std::to_string(curve_.indices.size());
    char separator = '\n';
    for (const std::int32_t index : curve_.indices) {
        lines += separator + std::to_string(index + 1);
        separator = ' ';
    }
    const std::int32_t n = curves_.points() - curve_.degree;
    file_.fail(knots_offset_,
               "the last " + plural(curve_.degree, "point") + " repeat the first " +
                   std::to_string(curve_.degree) +
                   ", so that an open curve would tear where it closes; write closed periodic, or "
                   "keep the first " +
                   std::to_string(n) + " points and add the lines" + lines);
}

void CurveReader::drop_repeated_points() {
    const auto n = static_cast<std::size_t>(curves_.points() - curve_.degree);
    curves_.control.resize(2 * n);
    if (!curves_.weights.empty()) curves_.weights.resize(n);
}

std::int32_t CurveReader::count(const char* keyword, std::int32_t smallest) {
    const auto& words = lines_.words();
    std::int32_t value = 0;
    if (words.size() != 2 || !parse(words[1], value) || value < smallest) {
        lines_.expected(keyword + std::string(" and a whole number from ") +
                        std::to_string(smallest));
    }
    return value;
}

// Reads n numbers, in lines of any length.
template <class Number>
std::vector<Number> CurveReader::numbers(std::int32_t n, const char* what) {
    std::vector<Number> values;
    const auto wanted = static_cast<std::size_t>(n);
    while (values.size() < wanted) {
        const std::string next = std::string(what) + " " + std::to_string(values.size() + 1) +
                                 " of " + std::to_string(n);
        if (!lines_.next()) lines_.expected(next);
        for (const std::string_view word : lines_.words()) {
            values.push_back(number<Number>(word, next.c_str()));
            if (values.size() > wanted)
                lines_.expected("no more than " + std::to_string(n) + " numbers", word);
        }
    }
    return values;
}

template <class Number>
Number CurveReader::number(std::string_view word, const char* what) const {
    Number value = 0;
    if (!parse(word, value)) lines_.expected(what, word);
    return value;
}

void CurveReader::refuse_repeated(bool is_there) const {
    if (is_there)
        lines_.fail(in_quotes(lines_.line()) + " is a second line of this kind for one curve");
}

void CurveReader::require_points() const {
    if (curves_.control.empty()) lines_.expected("points");
}

}  // namespace

bool is_curve_file(const TextFile& file) {
    LineReader lines(file, '#');
    if (!lines.next()) return false;
    const std::string_view first = lines.words()[0];
    if (first != "degree" && first != "closed" && first != "points") return false;
    while (lines.next())
        if (lines.words()[0] == "knots") return true;
    return false;
}

Curves read_curves(const std::string& path) { return CurveReader(TextFile(path)).read(); }

Curves read_curves(const std::string& path, std::string text) {
    return CurveReader(TextFile(path, std::move(text))).read();
}

namespace {

bool has_extension(const std::string& path, const std::string& extension) {
    const auto same = [](char a, char b) {
        return std::tolower(static_cast<unsigned char>(a)) == b;
    };
    if (path.size() < extension.size()) return false;
    return std::equal(extension.rbegin(), extension.rend(), path.rbegin(),
                      [&](char b, char a) { return same(a, b); });
}

}  // namespace

void write_curve_file(OutputFiles& files, const std::string& path, const Curves& curves) {
    std::ostream& out = files.add(path);
    if (has_extension(path, ".igs") || has_extension(path, ".iges")) return write_iges(out, curves);
    if (has_extension(path, ".stp") || has_extension(path, ".step")) return write_step(out, curves);
    if (has_extension(path, ".nml")) return write_namelist(out, curves);
    if (has_extension(path, ".dat")) return write_selig(out, curves);
    write_curves(out, curves);
}

namespace {

void write_numbers(std::ostream& out, const char* keyword, const std::vector<double>& values) {
    out << keyword << ' ' << values.size() << '\n';
    for (const double value : values) out << exact(value) << '\n';
}

void write_points(std::ostream& out, const Curves& curves) {
    out << "points " << curves.points() << '\n';
    for (std::size_t i = 0; i < curves.control.size(); i += 2) {
        out << exact(curves.control[i]) << ' ' << exact(curves.control[i + 1]) << '\n';
    }
    if (!curves.weights.empty()) write_numbers(out, "weights", curves.weights);
}

void write_indices(std::ostream& out, const Curve& curve) {
    out << "indices " << curve.indices.size() << '\n';
    for (const std::int32_t index : curve.indices) out << index + 1 << '\n';
}

}  // namespace

void write_curves(std::ostream& out, const Curves& curves) {
    out << "# B-spline; control points are numbered from 1 in this order\n";
    for (const Curve& curve : curves.curves) {
        const bool first = &curve == &curves.curves.front();
        if (!first) out << "curve\n";
        out << "degree " << curve.degree << "\nclosed " << closed_name(curve.closed) << '\n';
        if (first) write_points(out, curves);
        if (curve.indices != default_indices(curves.points(), curve.degree, curve.closed))
            write_indices(out, curve);
        write_numbers(out, "knots", curve.knots);
    }
}

}  // namespace cli
