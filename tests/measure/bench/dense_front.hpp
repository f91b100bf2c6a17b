// A front in the core's own storage, worked on by its kernels on one thread. This and
// dense_front.cpp are all of the benchmark that knows the core's inside.
#pragma once

#include "numbers.hpp"

#include <memory>
#include <string>

namespace bench {

class DenseFront {
public:
    // Returns entry (i, j) of the front, j >= i; the front is positive definite.
    static double entry(int front, int i, int j) {
        return i == j ? 2.0 * front : 1.0 / (1 + i + 2 * j);
    }
    static int constexpr right_hand_sides = 24;  // 20, padded as the engine pads them

    // kernel: HM_KERNEL_...; one the processor lacks: std::invalid_argument.
    DenseFront(int kernel, int pivots, int front);
    ~DenseFront();

    void restore();  // as it was, and right-hand sides of 1
    void factor();
    void update();                        // the border's part of the matrix it leaves to its parent
    void solve();                         // forward and backward
    double factored(int i, int j) const;  // j in the border
    static std::string kernel_name(int kernel);

private:
    struct Inside;
    std::unique_ptr<Inside> inside_;
};

}  // namespace bench
