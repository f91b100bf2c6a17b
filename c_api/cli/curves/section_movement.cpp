#include "curves/section_movement.hpp"

#include "basics/library.hpp"
#include "basics/numbers.hpp"

#include <algorithm>
#include <cmath>

namespace cli {

namespace {

double number(LineReader& lines, std::size_t word) {
    double value = 0;
    if (!parse(lines.words()[word], value)) lines.expected("a finite number", lines.words()[word]);
    return value;
}

void take_place(LineReader& lines, std::size_t word, hm_movement& movement) {
    if (!parse_place(lines.words()[word], movement.x, movement.y))
        lines.expected("a place X,Y", lines.words()[word]);
}

}  // namespace

bool parse_place(std::string_view word, double& x, double& y) {
    std::vector<double> place;
    if (!parse_list(word, place) || place.size() != 2) return false;
    x = place[0];
    y = place[1];
    return true;
}

bool is_section_movement(std::string_view word) {
    return word == "turn" || word == "shift" || word == "scale" || word == "flap";
}

SectionMovement section_movement_of(LineReader& lines) {
    SectionMovement line = {{}, sized<hm_movement>(), {}, true};
    const auto& words = lines.words();
    const std::string_view kind = words[0];
    const std::size_t n = words.size();
    if (kind == "shift") {
        if (n != 4) lines.expected("shift MARKER dx dy");
        line.movement.kind = HM_SHIFT;
        line.values = {number(lines, 2), number(lines, 3)};
    } else if (kind == "flap") {
        if (n != 4 && n != 5) lines.expected("flap MARKER X,Y degrees [length]");
        line.movement.kind = HM_FLAP;
        take_place(lines, 2, line.movement);
        line.values = {number(lines, 3)};
        if (n == 5) line.movement.length = number(lines, 4);
        if (n == 5 && !(line.movement.length > 0)) lines.expected("a length above 0", words[4]);
    } else {
        const bool turns = kind == "turn";
        if (n != 3 && n != 4)
            lines.expected(turns ? "turn MARKER degrees [X,Y]" : "scale MARKER factor [X,Y]");
        line.movement.kind = turns ? HM_ROTATE : HM_SCALE;
        line.values = {number(lines, 2) - (turns ? 0 : 1)};
        if (!turns && !(line.values[0] > -1)) lines.expected("a factor above 0", words[2]);
        line.has_centre = n == 4;
        if (n == 4) take_place(lines, 3, line.movement);
    }
    line.marker = std::string(words[1]);
    return line;
}

bool move_section(const hm_curves& curves, const hm_section& section,
                  const std::vector<hm_movement>& movements, const std::vector<double>& values,
                  MovedSection& moved, hm_error& error) {
    const auto n_movements = static_cast<std::int32_t>(movements.size());
    const auto length = 2 * static_cast<std::size_t>(curves.n_control);
    moved.move.resize(length);
    moved.derivatives.resize(values.size() * length);
    moved.start.resize(values.size());
    auto result = sized<hm_section_move>();
    result.move = moved.move.data();
    result.derivatives = moved.derivatives.data();
    result.start = moved.start.data();
    Block work;
    const hm_status status = with_memory(work, [&](hm_memory* memory) {
        return hm_move_section(&curves, &section, n_movements, movements.data(), values.data(),
                               &result, memory, &error);
    });
    if (status < 0) return false;
    moved.rms_error = result.error[0];
    moved.max_error = result.error[1];
    return true;
}

MovementError movement_error(std::string name, const hm_curves& curves, const MovedSection& moved) {
    MovementError error = {std::move(name), moved.rms_error, moved.max_error, 0};
    for (std::size_t axis = 0; axis < 2; ++axis) {
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (std::size_t k = axis; k < moved.move.size(); k += 2) {
            low = std::min(low, curves.control[k]);
            high = std::max(high, curves.control[k]);
        }
        error.chord = std::max(error.chord, high - low);
    }
    return error;
}

bool find_quarter_chord(const hm_curves& curves, const hm_section& section, double& x, double& y,
                        hm_error& error) {
    auto quantity = sized<hm_quantity>();
    quantity.kind = HM_THICKNESS;
    quantity.station = 0.25;
    double value = 0, at[2] = {};
    if (hm_measure(&curves, &section, 1, &quantity, &value, at, nullptr, &error) < 0) return false;
    x = at[0];
    y = at[1];
    return true;
}

std::vector<std::string> value_names(const hm_movement& movement) {
    switch (movement.kind) {
        case HM_ROTATE: return {"turn [degrees]"};
        case HM_SHIFT: return {"shift dx", "shift dy"};
        case HM_SCALE: return {"scale minus 1"};
        case HM_FLAP: return {"flap [degrees]"};
        case HM_PARSEC:
            return {"leading-edge radius",
                    "upper crest: station",
                    "upper crest: height",
                    "upper crest: second derivative",
                    "lower crest: station",
                    "lower crest: height",
                    "lower crest: second derivative",
                    "trailing edge: height",
                    "trailing edge: thickness",
                    "trailing edge: direction [degrees]",
                    "trailing edge: angle [degrees]"};
        case HM_BLADE:
            return {"metal angle, leading edge [degrees]", "metal angle, trailing edge [degrees]",
                    "stagger [degrees]"};
        default: break;
    }
    std::vector<std::string> names;
    for (std::int32_t k = 1; k <= movement.n_camber; ++k)
        names.push_back("camber " + std::to_string(k));
    for (std::int32_t k = 1; k <= movement.n_thickness; ++k)
        names.push_back("half thickness " + std::to_string(k));
    return names;
}

}  // namespace cli
