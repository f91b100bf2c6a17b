#include "sampling/design_space.hpp"

#include "basics/elementary.hpp"
#include "basics/geometry.hpp"
#include "basics/numbers.hpp"
#include "curves/section.hpp"
#include "files/paths.hpp"
#include "files/text_file.hpp"
#include "work/to_airfoil.hpp"

#include <cmath>
#include <vector>

namespace cli {

namespace {

// Sections of chord 1 by formulas, as points in order: counter-clockwise from the upper end of the
// trailing edge.

constexpr int section_panels = 80;  // on each side of the section

// Calls take(x, side) for the points in order, with side 1 above and -1 below. A sharp trailing
// edge is one point.
template <class Take>
void walk(bool is_sharp, const Take& take) {
    const auto place = [](int k) {
        return k == section_panels ? 1 : .5 * (1 - sine_cosine(pi * k / section_panels).cosine);
    };
    for (int k = section_panels; k >= 0; --k) take(place(k), 1);
    for (int k = 1; k <= section_panels - (is_sharp ? 1 : 0); ++k) take(place(k), -1);
}

double bernstein(const std::vector<double>& weights, double x) {  // de Casteljau
    std::vector<double> row = weights;
    for (std::size_t n = row.size(); n > 1; --n)
        for (std::size_t k = 0; k + 1 < n; ++k) row[k] = (1 - x) * row[k] + x * row[k + 1];
    return row.front();
}

// NACA's four-digit section with a sharp trailing edge, in chords: a camber line of two parabolas,
// whose height `camber` at the station camber_at may be negative, and the thickness normal to this
// line (E. Jacobs, K. Ward, R. Pinkerton, NACA Report 460 (1933); .1036 closes the trailing edge).
Section naca_section(double camber, double camber_at, double thickness) {
    Section section;
    walk(true, [&](double x, int side) {
        const double part = x < camber_at ? camber_at : 1 - camber_at,
                     behind = x < camber_at ? 0 : 1 - 2 * camber_at,
                     line = camber * (behind + x * (2 * camber_at - x)) / (part * part),
                     slope = 2 * camber * (camber_at - x) / (part * part);
        const double half =
            5 * thickness *
            (.2969 * std::sqrt(x) + x * (-.1260 + x * (-.3516 + x * (.2843 - .1036 * x))));
        const double across = x == 1 ? 0 : side * half / std::sqrt(1 + slope * slope);
        section.x.push_back(x - across * slope);
        section.y.push_back(line + across);
    });
    return section;
}

// Class-shape transformation with a round leading edge (B. Kulfan, J. Aircraft 45 (2008) 142):
// sqrt(x) (1 - x) times Bernstein polynomials with these weights, and half of `base` times x.
Section cst_section(const std::vector<double>& upper, const std::vector<double>& lower,
                    double base) {
    Section section;
    walk(base == 0, [&](double x, int side) {
        const std::vector<double>& weights = side > 0 ? upper : lower;
        section.x.push_back(x);
        section.y.push_back(std::sqrt(x) * (1 - x) * bernstein(weights, x) + .5 * side * base * x);
    });
    return section;
}

constexpr std::int32_t max_designs = 1000000000, max_weights = 20;
constexpr const char* sources[] = {"--variables", "--naca", "--cst", "--sections"};

}  // namespace

DesignSpace::DesignSpace(const Arguments& arguments, const Basis& basis) : basis_(basis) {
    if (basis.info().curves == 0) arguments.refuse("the basis has no curve");
    choose_kind(arguments);
    curve_ = arguments.whole("--airfoil-curve", 1, 1, basis.info().curves) - 1;
    on_chord_ = arguments.has("--on-chord") || kind_ == Kind::naca || kind_ == Kind::cst;
    if (arguments.has("--on-chord") && !has_files())
        arguments.refuse("--on-chord goes with --sections");
    for (const char* const option : {"--designs", "--ranges", "--range", "--sequence", "--seed"}) {
        const bool is_of_sequence = option != std::string("--designs");
        if (has_files() && arguments.has(option))
            arguments.refuse(std::string(option) +
                             ": the sections of --sections have no parameters");
        const bool is_idle =
            is_of_sequence && option != std::string("--seed") && arguments.has("--designs");
        if (is_idle && arguments.has(option))
            arguments.refuse(std::string(option) +
                             " and --designs both define the designs: name only one of them");
    }
    if (has_files()) {
        read_list(arguments.text("--sections"));
        count_ = static_cast<std::int64_t>(files_.size());
    } else if (arguments.has("--designs")) {
        values_ = DesignValues::of_table(arguments.text("--designs"), parameters_of(arguments));
        count_ = values_.count();
        description_ +=
            "Their parameters are those of the table " + arguments.text("--designs") + ". ";
    } else {
        if (!arguments.has("--count"))
            arguments.refuse("--count is missing: the number of designs");
        const auto chosen = static_cast<Sequence>(arguments.choice(
            "--sequence",
            {{"sobol", std::int32_t(Sequence::sobol)}, {"latin", std::int32_t(Sequence::latin)}}));
        const std::int32_t n = arguments.whole("--count", 0, 1, max_designs),
                           seed = arguments.whole("--seed", 1, 0, max_designs);
        const std::vector<DesignParameter> parameters = parameters_of(arguments);
        std::size_t varying = 0;
        for (const DesignParameter& one : parameters) varying += one.low < one.high ? 1 : 0;
        if (varying == 0)
            arguments.refuse("no parameter varies: give ranges by --range or --ranges");
        if (varying > Sobol::max_dimensions)
            arguments.refuse(std::to_string(varying) + " parameters vary; at most " +
                             std::to_string(Sobol::max_dimensions) + " may");
        values_ =
            DesignValues::of_sequence(parameters, chosen, n, static_cast<std::uint64_t>(seed));
        count_ = n;
        description_ += std::string("Their parameters are points of ") +
                        (chosen == Sequence::sobol ? "Sobol's sequence" : "a Latin hypercube") +
                        " with seed " + std::to_string(seed) + ". ";
    }
    if (arguments.has("--count"))
        count_ = std::min<std::int64_t>(count_, arguments.whole("--count", 0, 1, max_designs));
    if (count_ == 0) arguments.refuse("there are no designs");
}

void DesignSpace::choose_kind(const Arguments& arguments) {
    int chosen = 0;
    for (const char* const option : sources) chosen += arguments.has(option) ? 1 : 0;
    if (chosen > 1) arguments.refuse("name only one of --variables, --naca, --cst and --sections");
    if (arguments.has("--variables")) {
        kind_ = Kind::variables;
        map_path_ = arguments.text("--variables");
        map_ = read_variables(map_path_);
        if (map_.points != basis_.n_control())
            throw Failure(exit_file, arguments.text("--variables") + ": the variables move " +
                                         plural(map_.points, "control point") +
                                         ", but the curves of the basis have " +
                                         std::to_string(basis_.n_control()));
        description_ =
            "The designs move the design variables of " + arguments.text("--variables") + ". ";
    } else if (arguments.has("--naca")) {
        kind_ = Kind::naca;
        description_ = "The designs are NACA four-digit sections. ";
    } else if (arguments.has("--cst")) {
        kind_ = Kind::cst;
        const std::vector<std::int32_t> n = arguments.whole_list("--cst", 1, max_weights);
        if (n.size() != 2) arguments.refuse("--cst expects two numbers");
        n_upper_ = n[0];
        n_lower_ = n[1];
        description_ = "The designs are sections by class-shape transformation. ";
    } else if (arguments.has("--sections")) {
        kind_ = Kind::files;
        description_ =
            "The designs are the sections that " + arguments.text("--sections") + " lists. ";
    } else {
        description_ = "The designs move the control points. ";
    }
}

std::vector<DesignParameter> DesignSpace::parameters_of(const Arguments& arguments) const {
    std::vector<DesignParameter> all;
    const auto add = [&all](const std::string& name, std::int32_t n, double low, double high) {
        for (std::int32_t k = 1; k <= n; ++k) all.push_back({name + std::to_string(k), low, high});
    };
    if (kind_ == Kind::naca)
        all = {{"camber", 0, .07}, {"position", .2, .6}, {"thickness", .05, .2}};
    if (kind_ == Kind::cst) {
        add("upper", n_upper_, .1, .25);
        add("lower", n_lower_, -.25, -.05);
        all.push_back({"base", 0, 0});
    }
    double low = 0, high = 0;
    if (arguments.has("--range")) {
        const std::vector<double> range = arguments.number_list("--range");
        if (range.size() != 2 || range[0] > range[1])
            arguments.refuse("--range expects two numbers LOW,HIGH");
        if (!all.empty())
            arguments.refuse("--range goes with control points and --variables: use --ranges");
        low = range[0];
        high = range[1];
    }
    if (kind_ == Kind::variables) {
        for (std::int32_t k = 1; k <= map_.variables; ++k) {
            all.push_back({std::to_string(k), low, high});
            all.push_back({std::to_string(k) + "y", 0, 0});
        }
    }
    if (kind_ == Kind::control) {
        for (std::int32_t k = 1; k <= basis_.n_control(); ++k) {
            all.push_back({std::to_string(k) + "x", 0, 0});
            all.push_back({std::to_string(k) + "y", low, high});
        }
    }
    if (arguments.has("--ranges")) read_ranges(arguments.text("--ranges"), all);
    return all;
}

// Paths are relative to the folder of the list.
void DesignSpace::read_list(const std::string& path) {
    const TextFile file(path);
    LineReader lines(file, '#');
    const std::string folder = folder_of(path);
    while (lines.next()) files_.push_back(path_in(folder, std::string(lines.line())));
}

Section DesignSpace::section_of(const std::vector<double>& values) const {
    if (kind_ == Kind::naca) {
        const double position = values[1], thickness = values[2];
        if (!(position > 0 && position < 1) || !(thickness > 0))
            throw Failure(exit_unusable,
                          "the section needs a position of the camber between 0 and 1 and a "
                          "thickness above 0");
        return naca_section(values[0], position, thickness);
    }
    const auto first = values.begin(), middle = first + n_upper_, last = middle + n_lower_;
    return cst_section({first, middle}, {middle, last}, *last);
}

Design DesignSpace::design(std::int64_t number) const {
    Design out;
    if (has_files()) {
        out.section = files_[static_cast<std::size_t>(number)];
    } else {
        out.values = values_.values(number);
    }
    if (has_sections()) {
        const Section section = has_files() ? read_section(out.section) : section_of(out.values);
        const std::string name = has_files() ? out.section : "the section";
        ToAirfoil fitted = fit_to_airfoil(basis_, curve_, section, name, on_chord_);
        out.moves = std::move(fitted.moves);
        out.fit_error = fitted.max_error;
        out.warnings = section.warnings;
        return out;
    }
    out.moves = kind_ == Kind::variables
                    ? map_.control_moves(basis_.curves(), out.values, map_path_)
                    : out.values;
    out.moves.resize(2 * static_cast<std::size_t>(basis_.functions()));
    return out;
}

}  // namespace cli
