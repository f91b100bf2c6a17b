// The product and its transpose against OpenBLAS's dgemm and the machine's read bandwidth; admissible step and quality.
#include "clock.hpp"
#include "ours.hpp"
#include "peers.hpp"
#include "settings.hpp"

#include <functional>
#include <stdexcept>

namespace bench {
namespace {

class Product {
public:
    Product(Case const& its_case, hm_basis const* basis, Index functions, hm_executor const* executor)
        : basis_(basis), executor_(executor), m_(at(functions)), n_(its_case.mesh.x.size()) {
        x_ = its_case.mesh.x;
        x_.insert(x_.end(), its_case.mesh.y.begin(), its_case.mesh.y.end());
        for (std::size_t k = 0; k < 2 * m_; ++k) move_.push_back(1e-9 * static_cast<double>(k % 7));
        gradient_.assign(2 * m_, 0);
    }

    // In place: F read, coordinates read and written. The move is tiny, so that repeating it does no harm.
    void morph() {
        hm_points const from{x_.data(), y(), 1};
        hm_points_out const to{x_.data(), y(), 1};
        done(hm_morph(basis_, move_.data(), &from, &to, executor_, &error_), "hm_morph");
    }
    void adjoint() {
        hm_points const dj{x_.data(), y(), 1};
        done(hm_adjoint(basis_, &dj, gradient_.data(), executor_, &error_), "hm_adjoint");
    }
    double morph_seconds() { return time_of([&] { morph(); }); }

    struct Pair {
        double ours, theirs;
    };
    struct Pairs {
        Pair morph, adjoint;
    };
    // Against the fastest of the ways to store F and the coordinates that suit dgemm; medians of calls in turn.
    Pairs against(Blas const& its) {
        std::vector<double> by_node(m_ * n_), by_function(m_ * n_);
        for (std::size_t k = 0; k < m_; ++k) {
            done(hm_basis_values(basis_, static_cast<Index>(k), 0, &by_function[k * n_], &error_), "hm_basis_values");
            for (std::size_t i = 0; i < n_; ++i) by_node[i * m_ + k] = by_function[k * n_ + i];
        }
        std::vector<double> columns(2 * m_), pairs(move_);   // moves as [m x 2] and as [2 x m]
        for (std::size_t k = 0; k < m_; ++k) {
            columns[k] = move_[2 * k];
            columns[m_ + k] = move_[2 * k + 1];
        }
        check(its, by_node, columns);
        int const m = static_cast<int>(m_), n = static_cast<int>(n_);
        double *const x = x_.data(), *const g = gradient_.data(), *const f = by_node.data(), *const t = by_function.data();
        std::vector<std::function<void()>> const morphs = {
            [&] { its.dgemm('T', 'N', n, 2, m, 1, f, m, columns.data(), m, 1, x, n); },
            [&] { its.dgemm('N', 'N', 2, n, m, 1, pairs.data(), 2, f, m, 1, x, 2); },
            [&] { its.dgemm('N', 'N', n, 2, m, 1, t, n, columns.data(), m, 1, x, n); }};
        std::vector<std::function<void()>> const adjoints = {
            [&] { its.dgemm('N', 'N', m, 2, n, 1, f, m, x, n, 0, g, m); },
            [&] { its.dgemm('N', 'T', m, 2, n, 1, f, m, x, 2, 0, g, m); },
            [&] { its.dgemm('T', 'N', m, 2, n, 1, t, n, x, n, 0, g, m); }};
        auto const pair = [](auto const& one, auto const& other) {
            auto const seconds = in_turn(one, other);
            return Pair{median(seconds.first), median(seconds.second)};
        };
        return {pair([&] { morph(); }, fastest(morphs)), pair([&] { adjoint(); }, fastest(adjoints))};
    }

    double basis_bytes() const {
        hm_basis_info info{};
        info.struct_size = sizeof info;
        hm_error error{};
        require(hm_basis_info_get(basis_, &info, &error), error, "hm_basis_info_get");
        return static_cast<double>(info.bytes);
    }
    double nodes() const { return static_cast<double>(n_); }
    double morph_bytes(double number = 8) const { return nodes() * (number * static_cast<double>(m_) + 32); }
    double adjoint_bytes(double number = 8) const { return nodes() * (number * static_cast<double>(m_) + 16); }

private:
    hm_basis const* basis_;
    hm_executor const* executor_;
    std::size_t m_, n_;
    std::vector<double> x_, move_, gradient_;   // x_: all x, then all y
    hm_error error_{};

    double* y() { return x_.data() + n_; }
    void done(hm_status status, char const* call) const { require(status, error_, call); }
    static std::function<void()> fastest(std::vector<std::function<void()>> const& ways) {
        double best = not_measured;
        std::function<void()> its;
        for (auto const& way : ways) {
            double const seconds = time_of(way);
            if (best <= seconds) continue;
            best = seconds;
            its = way;
        }
        return its;
    }
    // Both sides move the points alike.
    void check(Blas const& its, std::vector<double> const& by_node, std::vector<double> const& columns) {
        std::vector<double> ours(2 * n_), theirs(2 * n_);
        int const m = static_cast<int>(m_), n = static_cast<int>(n_);
        hm_points_out const displacement{ours.data(), ours.data() + n_, 1};
        done(hm_morph(basis_, move_.data(), nullptr, &displacement, executor_, &error_), "hm_morph");
        its.dgemm('T', 'N', n, 2, m, 1, by_node.data(), m, columns.data(), m, 0, theirs.data(), n);
        for (std::size_t i = 0; i < 2 * n_; ++i)
            if (!(std::fabs(ours[i] - theirs[i]) < 1e-20)) throw std::runtime_error("our morph is not OpenBLAS's");
    }
};

void add_products(Case const& its_case, Settings const& settings, Limits const& limits, Table& table) {
    for (Index const functions : settings.functions) {
        Workspace workspace;
        Ours ours(its_case, workspace, functions, settings.executor, settings.kernel);
        ours.run();
        Product product(its_case, ours.basis(), functions, settings.executor);
        Product::Pairs pairs{{not_measured, not_measured}, {not_measured, not_measured}};
        if (blas() != nullptr) pairs = product.against(*blas());
        auto row = [&](char const* what, double bytes, auto const& work, Product::Pair seconds) {
            double const basis_bytes = product.basis_bytes();
            auto const read = [&] { limits.read_once(ours.basis(), static_cast<std::size_t>(basis_bytes)); };
            auto const with_reading = in_turn(work, read);
            double const alone = median(with_reading.first), reading = basis_bytes / median(with_reading.second);
            if (blas() == nullptr) seconds.ours = alone;
            table.add({what, its_case.name(), count(functions), milliseconds(seconds.ours),
                       {1e9 * seconds.ours / product.nodes(), "%.2f"}, {1e-9 * bytes / seconds.ours, "%.1f"},
                       percent(bytes / seconds.ours / limits.read), percent(bytes / alone / reading),
                       milliseconds(seconds.theirs), ratio(seconds.theirs / seconds.ours)});
        };
        row("morph", product.morph_bytes(), [&] { product.morph(); }, pairs.morph);
        row("adjoint", product.adjoint_bytes(), [&] { product.adjoint(); }, pairs.adjoint);
    }
}

// The same functions in single precision against double, call by call in turn.
void add_storage(Case const& its_case, Settings const& settings, Limits const& limits, Table& table) {
    for (Index const functions : settings.functions) {
        Workspace workspace;
        Ours ours(its_case, workspace, functions, settings.executor, settings.kernel);
        ours.run();
        hm_error error{};
        std::size_t bytes = 0;
        Block block;
        hm_basis* single = nullptr;
        require(hm_single_size(ours.basis(), &bytes, &error), error, "hm_single_size");
        require(hm_single_init(&single, block.give(bytes), bytes, ours.basis(), &error), error, "hm_single_init");
        Product wide(its_case, ours.basis(), functions, settings.executor),
            narrow(its_case, single, functions, settings.executor);
        auto row = [&](char const* what, double its_bytes, auto const& of_wide, auto const& of_narrow) {
            auto const both = in_turn(of_wide, of_narrow);
            double const first = least(both.first), second = least(both.second);
            table.add({what, its_case.name(), count(functions), milliseconds(first), milliseconds(second),
                       ratio(first / second), {1e-9 * its_bytes / second, "%.1f"},
                       percent(its_bytes / second / limits.read)});
        };
        row("morph", narrow.morph_bytes(4), [&] { wide.morph(); }, [&] { narrow.morph(); });
        row("adjoint", narrow.adjoint_bytes(4), [&] { wide.adjoint(); }, [&] { narrow.adjoint(); });
    }
}

void add_step(Case const& its_case, Settings const& settings, Table& table) {
    Workspace workspace;
    Ours ours(its_case, workspace, 20, settings.executor, settings.kernel);
    ours.run();
    Product product(its_case, ours.basis(), ours.functions(), settings.executor);
    double const morph = product.morph_seconds();

    hm_basis const* const basis = ours.basis();
    hm_executor const* const executor = settings.executor;
    hm_error error{};
    hm_mesh const mesh = its_case.mesh.view();
    std::vector<double> dx(its_case.mesh.x.size()), dy = dx, move(40, 1e-3);
    hm_points const displacement{dx.data(), dy.data(), 1};
    hm_points_out const to{dx.data(), dy.data(), 1};
    require(hm_morph(basis, move.data(), nullptr, &to, executor, &error), error, "hm_morph");
    double const step = time_of([&] {
        hm_step_report report{};
        report.struct_size = sizeof report;
        require(hm_admissible_step(basis, &mesh, nullptr, &displacement, executor, &report, &error), error,
                "hm_admissible_step");
    });
    double const quality = time_of([&] {
        hm_quality_report report{};
        report.struct_size = sizeof report;
        require(hm_quality(basis, &mesh, nullptr, &mesh.points, executor, &report, &error), error, "hm_quality");
    });
    double const both = time_of([&] {
        hm_step_report limit{};
        limit.struct_size = sizeof limit;
        hm_quality_report report{};
        report.struct_size = sizeof report;
        require(hm_assess(basis, &mesh, nullptr, &displacement, executor, &limit, &report, &error), error, "hm_assess");
    });
    table.add({its_case.name(), count(its_case.mesh.n_cells()), milliseconds(morph), milliseconds(step),
               milliseconds(quality), milliseconds(both), ratio(both / morph)});
}

}  // namespace

void bench_morph(Settings const& settings, Limits const& limits, Report& report) {
    if (blas() != nullptr) blas()->set_threads(settings.threads);
    Index largest = 0;
    for (Index const size : settings.sizes) largest = std::max(largest, size);
    largest = std::min(largest, Index{1000000});
    Table products{"Morph and adjoint [ms] (threads: " + std::to_string(settings.threads) + ")",
                   {"what", "mesh", "functions", "ours", "ns/node", "GB/s", "% of reading", "% of reading F", "dgemm",
                    "ratio"},
                   {}, {}};
    Table steps{"Admissible step and quality against a morph of 20 functions [ms]",
                {"mesh", "cells", "morph", "step", "quality", "both at once", "both / morph"}, {}, {}};
    Table storage{"Functions in single precision against double [ms] (threads: " + std::to_string(settings.threads) + ")",
                  {"what", "mesh", "functions", "double", "single", "ratio", "GB/s", "% of reading"}, {}, {}};
    Others others;
    for (std::string const& kind : settings.kinds) {
        say(kind + " " + std::to_string(largest) + ": morph");
        Case const its_case = make_case(kind, largest);
        if (kind == settings.kinds[0]) {
            add_products(make_case(kind, 5000), settings, limits, products);
            add_products(its_case, settings, limits, products);
            add_storage(its_case, settings, limits, storage);
        }
        add_step(its_case, settings, steps);
    }
    if (blas() == nullptr) products.notes.push_back("OpenBLAS: not installed (libopenblas-dev)");
    products.notes.push_back("Bytes: 8 m + 32 a node for the morph, in place; 8 m + 16 for the adjoint. Small meshes stay "
                             "in the caches; a million nodes in part, where the last one is large: % of reading F is of "
                             "the bandwidth of reading the basis, in turn with it.");
    products.notes.push_back("dgemm: the best of three ways to store F and the coordinates; medians of calls in turn.");
    products.notes.push_back(others.text());
    storage.notes.push_back("In turn, the least of each. Bytes: 4 m + 32 a node for the morph, 4 m + 16 for the adjoint.");
    storage.notes.push_back(others.text());
    report.finish(products);
    report.finish(storage);
    report.finish(steps);
}

}  // namespace bench
