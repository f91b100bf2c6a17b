#include "sampling/sample_pages.hpp"

#include "basics/json.hpp"
#include "basics/library.hpp"
#include "basics/numbers.hpp"
#include "basics/print.hpp"
#include "page/page_text.hpp"
#include "pictures/svg.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>

namespace cli {

namespace {

std::string without_numbers(const std::string& reason) {
    std::string out;
    bool in_number = false;
    for (const char c : reason) {
        const bool is_digit = c >= '0' && c <= '9';
        const bool continues = in_number && (c == '.' || c == 'e' || c == '-' || c == '+');
        if (!is_digit && !continues) out += c;
        else if (!in_number) out += '#';
        in_number = is_digit || continues;
    }
    return out;
}

}  // namespace

void SampleSummary::add(const SampleRow& row) {
    ++designs;
    if (!row.is_accepted()) {
        const std::string reason =
            row.section.empty() ? without_numbers(row.reason) : "the section cannot be taken";
        const bool is_new = reasons.count(reason) == 0;
        ++reasons[is_new && reasons.size() >= max_reasons ? "other reasons" : reason];
        return;
    }
    ++ways[row.way];
    ++splits[row.split];
    min.resize(row.numbers.size(), unknown);
    max.resize(row.numbers.size(), unknown);
    for (std::size_t k = 0; k < row.numbers.size(); ++k) {
        min[k] = std::fmin(min[k], row.numbers[k]);
        max[k] = std::fmax(max[k], row.numbers[k]);
    }
    if (accepted++ % stride_ != 0) return;
    rows.push_back(row);
    if (rows.size() < 2 * max_rows) return;
    std::vector<SampleRow> kept;
    for (std::size_t k = 0; k < rows.size(); k += 2) kept.push_back(rows[k]);
    rows.swap(kept);
    stride_ *= 2;
}

void print_summary(const SampleSummary& summary, const SampleRun& run) {
    print("designs          %lld, of which %lld are accepted, in %s\n",
          static_cast<long long>(summary.designs), static_cast<long long>(summary.accepted),
          plural(run.shards, "shard").c_str());
    for (const auto& one : summary.ways)
        print("%-16s %s\n", one.first.c_str(), plural(one.second, "design").c_str());
    for (const auto& one : summary.reasons)
        print("rejected         %lld: %s\n", static_cast<long long>(one.second), one.first.c_str());
    if (run.designs > 0)
        print("time             %s s, %s designs a second\n", brief(run.seconds).c_str(),
              brief(double(run.designs) / run.seconds).c_str());
    if (summary.accepted == 0) warn("no design is accepted: designs.csv has the reasons");
}

void print_json(const SampleSummary& summary, const SampleRun& run) {
    JsonObject object;
    object.add("designs", summary.designs).add("accepted", summary.accepted);
    object.add("shards", run.shards).add("continued_at", run.first);
    object.add("seconds", run.seconds);
    for (const char* const way : {"linear", "other", "substeps", "untangled", "improved"}) {
        const auto found = summary.ways.find(way);
        object.add(way, found == summary.ways.end() ? std::int64_t{0} : found->second);
    }
    print("%s\n", object.text().c_str());
}

namespace {

constexpr std::size_t max_thumbnails = 40, max_columns = 6;
constexpr double plot_side = 180, plot_margin = 34;  // of a scatter plot [pixels]

std::string outline_of(const hm_curves& curves, const std::vector<double>& control, double* box) {
    hm_curves moved = curves;
    moved.control = control.data();
    std::string path;
    constexpr int samples = 120;
    for (std::int32_t curve = 0; curve < curves.n_curves; ++curve) {
        const hm_curve& one = curves.curve[curve];
        const double begin = one.knots[one.degree], end = one.knots[one.n_indices];
        for (int k = 0; k <= samples; ++k) {
            double xy[2] = {0, 0};
            call(std::string("curve"), hm_curve_point, &moved, curve,
                 begin + (end - begin) * k / samples, std::int32_t{0}, xy);
            path += (k == 0 ? "M" : "L") + brief(xy[0]) + " " + brief(-xy[1]);
            const double place[2] = {xy[0], -xy[1]};
            for (int axis = 0; axis < 2; ++axis) {
                box[axis] = std::fmin(box[axis], place[axis]);
                box[2 + axis] = std::fmax(box[2 + axis], place[axis]);
            }
        }
    }
    return path;
}

void write_thumbnails(std::ostream& out, const Basis& basis, const DesignSpace& space,
                      const SampleSummary& summary) {
    struct Thumbnail {
        std::string path, text;
    };
    std::vector<Thumbnail> all;
    const double far = std::numeric_limits<double>::infinity();
    double box[4] = {far, far, -far, -far};
    const std::size_t every = (summary.rows.size() + max_thumbnails - 1) / max_thumbnails;
    for (std::size_t k = 0; k < summary.rows.size(); k += every) {
        const SampleRow& row = summary.rows[k];
        const std::vector<double> moves = space.design(row.design).moves;
        const hm_curves& before = basis.curves();
        std::vector<double> control(before.control, before.control + 2 * before.n_control);
        for (std::size_t i = 0; i < control.size(); ++i) control[i] += moves[i];
        all.push_back({outline_of(before, control, box), std::to_string(row.design + 1) + ": " +
                                                             row.way + ", quality " +
                                                             brief(row.numbers[0])});
    }

    const double width = box[2] - box[0], height = box[3] - box[1];
    const std::string view = brief(box[0] - .02 * width) + " " + brief(box[1] - .02 * width) + " " +
                             brief(1.04 * width) + " " + brief(height + .04 * width);
    out << "<section><h2>Sections</h2>\n<div class=\"thumbnails\">\n";
    for (const Thumbnail& one : all)
        out << "<figure><svg viewBox=\"" << view << "\"><path d=\"" << one.path
            << "\"/></svg><figcaption>" << escaped(one.text) << "</figcaption></figure>\n";
    out << "</div></section>\n";
}

// Writes a scatter plot of two columns of the table.
void write_scatter(std::ostream& out, const SampleTable& table, const SampleSummary& summary,
                   std::size_t x, std::size_t y) {
    const double x_low = summary.min[x], x_high = summary.max[x], y_low = summary.min[y],
                 y_high = summary.max[y];
    const auto share = [](double value, double low, double high) {
        return high > low ? (value - low) / (high - low) : .5;
    };
    out << "<svg viewBox=\"0 0 " << plot_side + 2 * plot_margin << " "
        << plot_side + 2 * plot_margin << "\"><rect x=\"" << plot_margin << "\" y=\"" << plot_margin
        << "\" width=\"" << plot_side << "\" height=\"" << plot_side << "\"/>";
    const auto text = [&](double at_x, double at_y, const char* anchor, const std::string& what) {
        out << "<text x=\"" << at_x << "\" y=\"" << at_y << "\" text-anchor=\"" << anchor << "\">"
            << escaped(what) << "</text>";
    };
    text(plot_margin, plot_side + plot_margin + 14, "start", brief(x_low));
    text(plot_side + plot_margin, plot_side + plot_margin + 14, "end", brief(x_high));
    text(plot_margin + plot_side / 2, plot_side + plot_margin + 28, "middle", table.numbers()[x]);
    text(plot_margin, plot_margin - 18, "start", table.numbers()[y]);
    text(plot_margin, plot_margin - 5, "start", brief(y_low) + " .. " + brief(y_high));
    for (const SampleRow& row : summary.rows) {
        if (!std::isfinite(row.numbers[x]) || !std::isfinite(row.numbers[y])) continue;
        const double px = plot_margin + plot_side * share(row.numbers[x], x_low, x_high),
                     py = plot_margin + plot_side * (1 - share(row.numbers[y], y_low, y_high));
        out << "<circle class=\"" << row.split << "\" cx=\"" << std::round(10 * px) / 10
            << "\" cy=\"" << std::round(10 * py) / 10 << "\" r=\"2\"/>";
    }
    out << "</svg>\n";
}

bool varies(const SampleSummary& summary, std::size_t column) {
    return column < summary.min.size() && std::isfinite(summary.min[column]) &&
           std::isfinite(summary.max[column]) && summary.min[column] < summary.max[column];
}

void write_scatters(std::ostream& out, const SampleTable& table, const SampleSummary& summary) {
    std::vector<std::size_t> across, up;
    const std::size_t n = table.numbers().size(), first = table.first_parameter();
    for (std::size_t k = first; k < n && across.size() < max_columns; ++k)
        if (varies(summary, k)) across.push_back(k);
    for (std::size_t k = 0; k < first; ++k) {
        if (!varies(summary, k)) continue;
        const std::string& name = table.numbers()[k];
        if (name == "min_quality" || name == "area" || name == "max_thickness" ||
            name == "max_camber" || name == "fit_error")
            up.push_back(k);
    }
    if (across.empty() && !up.empty()) across = up;
    out << "<section><h2>Designs, measures and quality</h2>\n<p class=\"key\">"
           "<span class=\"train\">● train</span><span class=\"test\">● test</span>"
           "<span class=\"out\">● out of range</span></p>\n<div class=\"plots\">\n";
    for (std::size_t k = 1; k < across.size(); ++k)
        write_scatter(out, table, summary, across[0], across[k]);
    for (const std::size_t y : up)
        for (const std::size_t x : across)
            if (x != y) write_scatter(out, table, summary, x, y);
    out << "</div></section>\n";
}

void write_counts(std::ostream& out, const char* title,
                  const std::map<std::string, std::int64_t>& counts) {
    if (counts.empty()) return;
    out << "\n| " << title << " | designs |\n|---|---|\n";
    for (const auto& one : counts)
        out << "| " << readable(one.first, false) << " | " << one.second << " |\n";
}

}  // namespace

void write_sample_index(std::ostream& out, const Basis& basis, const DesignSpace& space,
                        const SampleTable& table, const SampleSummary& summary) {
    out << sample_page.before_data << "<section class=\"verdict "
        << (summary.accepted > 0 ? "good" : "bad") << "\"><b>" << summary.accepted << " of "
        << plural(summary.designs, "design") << (summary.designs == 1 ? " is" : " are")
        << " accepted</b><span>" << escaped(space.description())
        << "<a href=\"designs.csv\">designs.csv</a> lists all of them, and "
           "<a href=\"README.md\">README.md</a> describes the files.</span></section>\n";
    if (!summary.rows.empty()) {
        write_thumbnails(out, basis, space, summary);
        write_scatters(out, table, summary);
    }
    out << sample_page.after_data;
}

void write_sample_description(std::ostream& out, const SampleDescription& description,
                              const DesignSpace& space, const SampleTable& table,
                              const SampleSummary& summary) {
    out << "# Airfoil meshes with the same connectivity\n\n"
        << readable(space.description(), false) << "Each accepted design is the mesh "
        << readable(description.mesh, false) << ", moved by the functions of "
        << readable(description.basis, false)
        << "; point k and cell k are the same in all of them. " << summary.accepted << " of "
        << summary.designs << " designs are accepted.\n\n"
        << "`designs.csv` has a line for each design, with the reason where the design is "
           "rejected. `shards/*.npz` have the accepted designs in the order of the table "
           "(`numpy.load`), and `index.html` shows some of them.\n";
    write_counts(out, "way", summary.ways);
    write_counts(out, "split", summary.splits);
    write_counts(out, "reason of rejection", summary.reasons);
    out << "\n" << readable(description.splits, false) << "\n";
    if (!space.parameters().empty()) {
        out << "\n| parameter | low | high |\n|---|---|---|\n";
        for (const std::size_t k : table.shown_parameters()) {
            const DesignParameter& one = space.parameters()[k];
            out << "| " << one.name << " | " << brief(one.low) << " | " << brief(one.high)
                << " |\n";
        }
        if (table.shown_parameters().empty()) out << "| (none varies) | | |\n";
    }
    if (!summary.min.empty()) {
        out << "\n| column of accepted designs | smallest | largest |\n|---|---|---|\n";
        for (std::size_t k = 0; k < table.first_parameter(); ++k)
            out << "| " << table.numbers()[k] << " | " << brief(summary.min[k]) << " | "
                << brief(summary.max[k]) << " |\n";
    }
    out << "\nArrays of each shard, with n accepted designs:\n\n"
        << readable(description.arrays, true) << "\nHow the set was made (`set.txt`):\n\n```\n"
        << readable(description.settings, true) << "```\n";
}

}  // namespace cli
