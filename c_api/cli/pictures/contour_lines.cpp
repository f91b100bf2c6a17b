#include "pictures/contour_lines.hpp"

#include "pictures/triangles.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace cli {

namespace {

constexpr std::size_t none = static_cast<std::size_t>(-1);

// One end of the piece of a line in a triangle. The end lies on an edge of the triangle, where the
// piece in the neighbouring triangle begins.
struct End {
    std::int32_t multiple, a, b;  // a < b are the points of the edge
    Point at;
};

class Tracer {
public:
    Tracer(const Mesh& mesh, const std::vector<double>& values, double step)
        : mesh_(mesh), values_(values), step_(step) {}

    void add(const Corners& corners) {
        const auto value = [&](std::size_t i) {
            return values_[static_cast<std::size_t>(corners[i])] / step_;
        };
        const auto [low, high] = std::minmax({value(0), value(1), value(2)});
        for (double level = std::floor(low) + 1; level <= high; ++level) {
            for (std::size_t i = 0; i < 3; ++i) {
                const std::size_t next = (i + 1) % 3;
                if ((value(i) < level) == (value(next) < level))
                    continue;  // the line crosses two of three edges
                ends_.push_back(end_on(std::min(corners[i], corners[next]),
                                       std::max(corners[i], corners[next]), level));
            }
        }
    }

    std::vector<ContourLine> lines() {
        join();
        std::vector<ContourLine> lines;
        std::vector<bool> used(ends_.size() / 2);
        const auto follow = [&](std::size_t end) {  // follows the line from this end of a piece
            ContourLine line = {ends_[end].multiple, {ends_[end].at}};
            while (end != none && !used[end / 2]) {
                used[end / 2] = true;
                line.points.push_back(ends_[end ^ 1].at);
                end = partner_[end ^ 1];
            }
            lines.push_back(std::move(line));
        };
        for (std::size_t end = 0; end < ends_.size(); ++end) {
            if (partner_[end] == none && !used[end / 2]) follow(end);
        }
        for (std::size_t end = 0; end < ends_.size(); end += 2) {
            if (!used[end / 2]) follow(end);
        }
        return lines;
    }

private:
    End end_on(std::int32_t a, std::int32_t b, double level) const {
        const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
        const double from = values_[i] / step_, t = (level - from) / (values_[j] / step_ - from);
        return {static_cast<std::int32_t>(level),
                a,
                b,
                {mesh_.x[i] + t * (mesh_.x[j] - mesh_.x[i]),
                 mesh_.y[i] + t * (mesh_.y[j] - mesh_.y[i])}};
    }

    // Ends 2k and 2k + 1 belong to one triangle; two ends on the same edge belong to neighbours.
    void join() {
        const auto key = [this](std::size_t end) {
            return std::tie(ends_[end].multiple, ends_[end].a, ends_[end].b);
        };
        std::vector<std::size_t> order(ends_.size());
        for (std::size_t end = 0; end < order.size(); ++end) order[end] = end;
        std::sort(order.begin(), order.end(),
                  [&](std::size_t i, std::size_t j) { return key(i) < key(j); });
        partner_.assign(ends_.size(), none);
        for (std::size_t k = 0; k + 1 < order.size(); ++k) {
            if (key(order[k]) != key(order[k + 1])) continue;
            partner_[order[k]] = order[k + 1];
            partner_[order[k + 1]] = order[k];
            ++k;
        }
    }

    const Mesh& mesh_;
    const std::vector<double>& values_;
    double step_;
    std::vector<End> ends_;
    std::vector<std::size_t> partner_;  // the end in the neighbouring triangle, or none
};

}  // namespace

std::vector<ContourLine> contour_lines(const Mesh& mesh, const std::vector<double>& values,
                                       double step, const Box& window) {
    Tracer tracer(mesh, values, step);
    for_each_triangle(mesh, window, [&](const Corners& corners) { tracer.add(corners); });
    return tracer.lines();
}

}  // namespace cli
