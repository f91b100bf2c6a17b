// The core's dense kernels against OpenBLAS, one thread, fronts alone and warm.
#include "clock.hpp"
#include "dense_front.hpp"
#include "peers.hpp"
#include "settings.hpp"

#include <cmath>
#include <stdexcept>

namespace bench {
namespace {

// A front as BLAS stores it. Read by columns, our rows are the lower triangle it wants.
class BlasFront {
public:
    BlasFront(Blas const& blas, int pivots, int front)
        : its_(blas), pivots_(pivots), front_(front) {
        std::size_t const p = static_cast<std::size_t>(pivots), n = static_cast<std::size_t>(front);
        original_.assign(p * n, 0);
        for (int i = 0; i < pivots; ++i)
            for (int j = i; j < front; ++j) original_[index(i, j)] = DenseFront::entry(front, i, j);
        panel_ = original_;
        update_.assign((n - p) * (n - p), 0);
        restore();
    }

    void restore() {
        std::copy(original_.begin(), original_.end(), panel_.begin());
        sides_.assign(static_cast<std::size_t>(front_) * DenseFront::right_hand_sides, 1);
    }
    void factor() {
        if (its_.dpotrf(pivots_, panel_.data(), front_) != 0)
            throw std::runtime_error("dpotrf failed");
        if (border() > 0)
            its_.dtrsm('T', border(), pivots_, panel_.data(), front_, below(), front_);
    }
    void update() {
        its_.dsyrk(border(), pivots_, -1, below(), front_, 1, update_.data(), border());
    }
    void solve() {
        int const wide = DenseFront::right_hand_sides, p = pivots_, n = front_;
        double *const y = sides_.data(), *const rest = y + static_cast<std::ptrdiff_t>(p) * wide;
        its_.dtrsm('T', wide, p, panel_.data(), n, y, wide);
        its_.dgemm('N', 'T', wide, n - p, p, -1, y, wide, below(), n, 1, rest, wide);
        its_.dgemm('N', 'N', wide, p, n - p, -1, rest, wide, below(), n, 1, y, wide);
        its_.dtrsm('N', wide, p, panel_.data(), n, y, wide);
    }

    // The largest difference of the two factors' borders: only they are stored alike.
    double difference(DenseFront const& ours) const {
        double largest = 0;
        for (int i = 0; i < pivots_; ++i)
            for (int j = pivots_; j < front_; ++j)
                largest = std::fmax(largest, std::fabs(ours.factored(i, j) - panel_[index(i, j)]));
        return largest;
    }

private:
    Blas const& its_;
    int pivots_, front_;
    Numbers original_, panel_, update_, sides_;

    int border() const { return front_ - pivots_; }
    double* below() { return panel_.data() + pivots_; }
    std::size_t index(int i, int j) const {
        return static_cast<std::size_t>(i) * static_cast<std::size_t>(front_) +
               static_cast<std::size_t>(j);
    }
};

struct FrontTimes {
    double factor = not_measured, update = not_measured, solve = not_measured;
};

template <class Front>
double time_one(Front& front, void (Front::*work)()) {
    std::vector<double> seconds;
    Stopwatch whole;
    while (seconds.size() < 6 || (seconds.size() < 1000 && whole.seconds() < 0.15)) {
        Stopwatch one;
        (front.*work)();
        seconds.push_back(one.seconds());
    }
    return median(seconds);
}

// Medians of single calls, each after a restoration that is not counted.
template <class Front>
FrontTimes time_front(Front& front, bool has_border) {
    FrontTimes out;
    std::vector<double> factor, solve;
    Stopwatch whole;
    while (factor.size() < 6 || (factor.size() < 1000 && whole.seconds() < 0.3)) {
        front.restore();
        Stopwatch watch;
        front.factor();
        factor.push_back(watch.lap());
        if (!has_border) continue;
        front.solve();
        solve.push_back(watch.lap());
    }
    out.factor = median(factor);
    out.solve = median(solve);
    if (has_border) out.update = time_one(front, &Front::update);
    return out;
}

void add_front(int front, int pivots, int kernel, Limits const& limits, Table& table) {
    bool const has_border = pivots < front;
    DenseFront our_front(kernel, pivots, front);
    FrontTimes const ours = time_front(our_front, has_border);
    FrontTimes theirs;
    if (Blas const* const library = blas()) {
        BlasFront their_front(*library, pivots, front);
        theirs = time_front(their_front, has_border);
        if (!(their_front.difference(our_front) < 1e-10))
            throw std::runtime_error("our factor is not OpenBLAS's");
    }
    auto row = [&](char const* what, double flops, double our_seconds, double their_seconds) {
        table.add({what,
                   count(front),
                   count(pivots),
                   {1e-9 * flops / our_seconds, "%.1f"},
                   {1e-9 * flops / their_seconds, "%.1f"},
                   ratio(their_seconds / our_seconds),
                   percent(flops / our_seconds / limits.peak),
                   percent(flops / their_seconds / limits.peak)});
    };
    double const p = pivots, b = front - pivots, sides = DenseFront::right_hand_sides;
    double const factor_flops = p * p * (p / 3 + b), update_flops = b * (b + 1) * p;
    row("factor", factor_flops, ours.factor, theirs.factor);
    if (!has_border) return;
    row("update", update_flops, ours.update, theirs.update);
    row("both", factor_flops + update_flops, ours.factor + ours.update,
        theirs.factor + theirs.update);
    row("solve, 24 wide", 2 * sides * p * (p + 2 * b), ours.solve, theirs.solve);
}

}  // namespace

void bench_dense(Settings const& settings, Limits const& limits, Report& report) {
    say("dense kernels");
    Table table{
        "Dense kernels, one thread [GFLOP/s]; ours: " + DenseFront::kernel_name(settings.kernel),
        {"what", "front", "pivots", "ours", "OpenBLAS", "ratio", "ours % of peak", "theirs %"},
        {},
        {}};
    Others others;
    if (blas() != nullptr) blas()->set_threads(1);
    for (int const front : {64, 96, 128, 192, 256, 384, 512, 768, 1024, 1536, 2048}) {
        add_front(front, front, settings.kernel, limits, table);      // the root
        add_front(front, front / 3, settings.kernel, limits, table);  // as dissection makes them
    }
    if (blas() != nullptr) blas()->set_threads(settings.threads);
    else table.notes.push_back("OpenBLAS: not installed (libopenblas-dev)");
    table.notes.push_back(
        "factor: dpotrf and dtrsm; update: dsyrk; solve: dtrsm and dgemm. Flops are those of the "
        "plain "
        "algorithm on both sides. Peak: multiply-adds in registers, as above.");
    table.notes.push_back(others.text());
    report.finish(table);
}

}  // namespace bench
