// The product and its transpose beside the machine's read bandwidth; admissible step and quality.
#include <harmorph_bases.h>
#include <harmorph_study.h>
#include "clock.hpp"
#include "ours.hpp"
#include "settings.hpp"

#include <cstring>
#include <functional>
#include <fixtures/memory.hpp>

namespace bench {
namespace {

struct Operator {
    char const* name;
    Index kind;
    Index numbers;  // of a value
};
constexpr Operator laplace{"Laplace", HM_LAPLACE, 1}, conformal{"conformal", HM_CONFORMAL, 2};

class Product {
public:
    // All arrays are in the same kind of pages.
    Product(Case const& mesh_case, hm_basis const* basis, Index functions,
            hm_executor const* executor, Pages pages = Pages::huge,
            Operator const& chosen = laplace)
        : case_(mesh_case),
          operator_(chosen),
          basis_(basis),
          executor_(executor),
          m_(at(functions)),
          n_(mesh_case.mesh.x.size()),
          pages_(pages),
          xy_(pages) {
        x_ = xy_.numbers(2 * n_);
        std::copy(mesh_case.mesh.x.begin(), mesh_case.mesh.x.end(), x_);
        std::copy(mesh_case.mesh.y.begin(), mesh_case.mesh.y.end(), y());
        for (std::size_t k = 0; k < 2 * m_; ++k) move_.push_back(1e-9 * static_cast<double>(k % 7));
        gradient_.assign(2 * m_, 0);
    }

    // In place: F read, coordinates read and written. The move is tiny, so that repeating it does
    // no harm.
    void morph() {
        hm_points const from{x_, y(), 1};
        hm_points_out const to{x_, y(), 1};
        done(hm_morph(basis_, move_.data(), &from, &to, executor_, &error_), "hm_morph");
    }
    void adjoint() {
        hm_points const dj{x_, y(), 1};
        done(hm_adjoint(basis_, &dj, gradient_.data(), executor_, &error_), "hm_adjoint");
    }

    double basis_bytes() const {
        hm_basis_info info{};
        info.struct_size = sizeof info;
        hm_error error{};
        require(hm_basis_info_get(basis_, &info, &error), error, "hm_basis_info_get");
        return static_cast<double>(info.bytes);
    }
    double nodes() const { return static_cast<double>(n_); }
    double morph_bytes(double number = 8) const { return nodes() * (number * numbers() + 32); }
    double adjoint_bytes(double number = 8) const { return nodes() * (number * numbers() + 16); }

    // Milliseconds and bytes of one product, in turn with reading the basis.
    void add_row(char const* what, double bytes, std::function<void()> const& work,
                 Limits const& limits, Table& table) const {
        auto const read = [&] {
            limits.read_once(basis_, static_cast<std::size_t>(basis_bytes()));
        };
        auto const with_reading = in_turn(work, read);
        double const alone = least(with_reading.first),
                     reading = basis_bytes() / least(with_reading.second);
        table.add({what,
                   case_.name(),
                   operator_.name,
                   count(static_cast<Index>(m_)),
                   pages_ == Pages::huge ? "2 MiB" : "4 KiB",
                   milliseconds(alone),
                   {1e9 * alone / nodes(), "%.2f"},
                   {1e-9 * bytes / alone, "%.1f"},
                   {1e-9 * reading, "%.1f"},
                   percent(bytes / alone / reading)});
    }

private:
    Case const& case_;
    Operator operator_;
    hm_basis const* basis_;
    hm_executor const* executor_;
    std::size_t m_, n_;  // functions, points
    Pages pages_;
    Block xy_;
    double* x_ = nullptr;  // all x, then all y
    std::vector<double> move_, gradient_;
    hm_error error_{};

    double* y() { return x_ + n_; }
    double numbers() const { return static_cast<double>(m_) * operator_.numbers; }  // of a point
    void done(hm_status status, char const* call) const { require(status, error_, call); }
};

void add_products(Case const& mesh_case, Operator const& chosen, Settings const& settings,
                  Limits const& limits, Table& table) {
    for (Index const functions : settings.functions) {
        Workspace workspace;
        Ours ours(mesh_case, workspace, functions, settings.executor, HM_DIRECT, chosen.kind);
        ours.run();
        for (Pages const pages : {Pages::plain, Pages::huge}) {
            hm_error error{};
            hm_basis_info info{};
            info.struct_size = sizeof info;
            require(hm_basis_info_get(ours.basis(), &info, &error), error, "hm_basis_info_get");
            Block block(pages);
            std::memcpy(block.give(info.bytes), ours.basis(), info.bytes);
            hm_basis const* basis = nullptr;
            require(hm_basis_attach(&basis, block.give(0), info.bytes, nullptr, &error), error,
                    "hm_basis_attach");
            Product product(mesh_case, basis, functions, settings.executor, pages, chosen);
            product.add_row(
                "morph", product.morph_bytes(), [&] { product.morph(); }, limits, table);
            product.add_row(
                "adjoint", product.adjoint_bytes(), [&] { product.adjoint(); }, limits, table);
        }
    }
}

// Compares functions in single and in double precision, call by call in turn.
void add_storage(Case const& mesh_case, Settings const& settings, Limits const& limits,
                 Table& table) {
    for (Index const functions : settings.functions) {
        Workspace workspace;
        Ours ours(mesh_case, workspace, functions, settings.executor);
        ours.run();
        hm_error error{};
        std::size_t bytes = 0;
        Block block;
        hm_basis* single = nullptr;
        require(fixtures::single_size(ours.basis(), &bytes, &error), error, "hm_single");
        require(hm_single_init(&single, fixtures::Memory(block.give(bytes), bytes), ours.basis(),
                               &error),
                error, "hm_single_init");
        Product wide(mesh_case, ours.basis(), functions, settings.executor),
            narrow(mesh_case, single, functions, settings.executor);
        auto row = [&](char const* what, double bytes_read, auto const& of_wide,
                       auto const& of_narrow) {
            auto const both = in_turn(of_wide, of_narrow);
            double const first = least(both.first), second = least(both.second);
            auto const with_reading = in_turn(of_narrow, [&] { limits.read_once(single, bytes); });
            double const reading = static_cast<double>(bytes) / least(with_reading.second);
            table.add({what,
                       mesh_case.name(),
                       count(functions),
                       milliseconds(first),
                       milliseconds(second),
                       ratio(first / second),
                       {1e-9 * bytes_read / second, "%.1f"},
                       {1e-9 * reading, "%.1f"},
                       percent(bytes_read / least(with_reading.first) / reading)});
        };
        row(
            "morph", narrow.morph_bytes(4), [&] { wide.morph(); }, [&] { narrow.morph(); });
        row(
            "adjoint", narrow.adjoint_bytes(4), [&] { wide.adjoint(); }, [&] { narrow.adjoint(); });
    }
}

void add_step(Case const& mesh_case, Settings const& settings, Table& table) {
    Workspace workspace;
    Ours ours(mesh_case, workspace, 20, settings.executor);
    ours.run();
    Product product(mesh_case, ours.basis(), ours.functions(), settings.executor);
    hm_basis const* const basis = ours.basis();
    hm_executor const* const executor = settings.executor;
    hm_error error{};
    hm_mesh const mesh = mesh_case.mesh.view();
    std::vector<double> dx(mesh_case.mesh.x.size()), dy = dx, move(40, 1e-3);
    hm_points const displacement{dx.data(), dy.data(), 1};
    hm_points_out const to{dx.data(), dy.data(), 1};
    require(hm_morph(basis, move.data(), nullptr, &to, executor, &error), error, "hm_morph");
    double const step = time_of([&] {
        hm_step_report report{};
        report.struct_size = sizeof report;
        require(hm_assess(basis, &mesh, nullptr, &displacement, nullptr, executor, &report, nullptr,
                          &error),
                error, "hm_assess of the step");
    });
    double const quality = time_of([&] {
        hm_quality_report report{};
        report.struct_size = sizeof report;
        require(hm_assess(basis, &mesh, nullptr, nullptr, &mesh.points, executor, nullptr, &report,
                          &error),
                error, "hm_assess of the quality");
    });
    auto const assess = [&] {
        hm_step_report limit{};
        limit.struct_size = sizeof limit;
        hm_quality_report report{};
        report.struct_size = sizeof report;
        require(hm_assess(basis, &mesh, nullptr, &displacement, nullptr, executor, &limit, &report,
                          &error),
                error, "hm_assess");
    };
    auto const in_turns = in_turn([&] { product.morph(); }, assess);
    double const morph = least(in_turns.first), both = least(in_turns.second);
    table.add({mesh_case.name(),
               count(mesh_case.mesh.n_cells()),
               milliseconds(morph),
               milliseconds(step),
               milliseconds(quality),
               milliseconds(both),
               {1e9 * both / mesh_case.mesh.n_cells(), "%.2f"},
               ratio(both / morph)});
}

}  // namespace

void bench_morph(Settings const& settings, Limits const& limits, Report& report) {
    Index largest = 0;
    for (Index const size : settings.sizes) largest = std::max(largest, size);
    largest = std::min(largest, Index{1000000});
    Table products{"Morph and adjoint [ms] (threads: " + std::to_string(settings.threads) + ")",
                   {"what", "mesh", "operator", "functions", "pages", "ours", "ns/node", "GB/s",
                    "reading", "% of reading"},
                   {},
                   {}};
    Table steps{
        "Admissible step and quality against a morph of 20 functions [ms]",
        {"mesh", "cells", "morph", "step", "quality", "both at once", "ns/cell", "both / morph"},
        {},
        {}};
    Table storage{"Functions in single precision against double [ms] (threads: " +
                      std::to_string(settings.threads) + ")",
                  {"what", "mesh", "functions", "double", "single", "ratio", "GB/s", "reading",
                   "% of reading"},
                  {},
                  {}};
    Others others;
    for (std::string const& kind : settings.kinds) {
        say(kind + " " + std::to_string(largest) + ": morph");
        Case const mesh_case = make_case(kind, largest);
        if (kind == settings.kinds[0]) {
            Case const small = make_case(kind, 5000);
            for (Operator const& chosen : {laplace, conformal})
                add_products(small, chosen, settings, limits, products);
            for (Operator const& chosen : {laplace, conformal})
                add_products(mesh_case, chosen, settings, limits, products);
            add_storage(mesh_case, settings, limits, storage);
        }
        add_step(mesh_case, settings, steps);
    }
    products.notes.push_back(
        "Bytes: 8 m + 32 a node for the morph, in place; 8 m + 16 for the adjoint; m: functions, "
        "or two numbers of "
        "each where they are conformal. Reading: of the basis "
        "[GB/s], in turn with the product, in the same pages.");
    products.notes.push_back(others.text());
    storage.notes.push_back(
        "In turn, the least of each. Bytes: 4 m + 32 a node for the morph, 4 m + 16 for the "
        "adjoint. Reading: of the "
        "narrow basis [GB/s], in turn with the product.");
    storage.notes.push_back(others.text());
    steps.notes.push_back(
        "Morph and both at once: in turn, the least of each; step and quality: medians.");
    report.finish(products);
    report.finish(storage);
    report.finish(steps);
}

}  // namespace bench
