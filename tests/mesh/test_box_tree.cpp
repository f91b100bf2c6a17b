// The nearest of many items, against looking at all of them.
#include <fixtures/core.hpp>
#include <fixtures/guarded.hpp>
#include "mesh/locate.hpp"

using namespace fixtures;
using harmorph::Box;
using harmorph::BoxTree;
using harmorph::Index;
using harmorph::Nearest;
using harmorph::Vec2;

namespace {

// A tree over boxes, in a block of exactly the size it asks for.
class Tree {
public:
    explicit Tree(std::vector<Box> const& boxes) : boxes_(boxes) {
        block_ =
            laid_out([&](harmorph::Arena& arena) { tree_.lay_out(arena, Index(boxes.size())); }, 8);
        tree_.build([&](Index item) { return boxes_[std::size_t(item)]; });
        REQUIRE(block_->guards_intact());
    }
    Nearest nearest(Vec2 point, Nearest best = {}) const {
        asked_ = 0;
        return tree_.nearest(point, best, [&](Index item) {
            ++asked_;
            return boxes_[std::size_t(item)].squared_distance(point);
        });
    }
    int asked() const { return asked_; }
    BoxTree const& tree() const { return tree_; }

private:
    std::vector<Box> boxes_;
    std::unique_ptr<Guarded> block_;
    BoxTree tree_;
    mutable int asked_ = 0;
};

Nearest by_looking(std::vector<Box> const& boxes, Vec2 point) {
    Nearest best;
    for (std::size_t k = 0; k < boxes.size(); ++k) {
        double const squared = boxes[k].squared_distance(point);
        if (squared < best.squared) best = {Index(k), squared};
    }
    return best;
}

Box box_of(Vec2 corner, Vec2 size) {
    Box box;
    box.include(corner);
    box.include(corner + size);
    return box;
}

std::vector<Box> random_boxes(std::size_t n, unsigned seed, double grid = 0) {
    std::mt19937 random(seed);
    std::vector<Box> boxes;
    auto const place = [&] {
        return grid > 0 ? std::floor(uniform(random) / grid) * grid : uniform(random);
    };
    for (std::size_t k = 0; k < n; ++k) {
        Vec2 const corner{place(), place()};
        boxes.push_back(box_of(corner, {0.05 * uniform(random), 0.05 * uniform(random)}));
    }
    return boxes;
}

}  // namespace

TEST_CASE("the nearest item is found for every number of items") {
    std::mt19937 random(4);
    for (std::size_t n = 0; n < 70; ++n) {
        std::vector<Box> const boxes = random_boxes(n, unsigned(n));
        Tree const tree(boxes);
        for (int k = 0; k < 20; ++k) {
            Vec2 const point{3 * uniform(random) - 1, 3 * uniform(random) - 1};
            Nearest const found = tree.nearest(point), expected = by_looking(boxes, point);
            CHECK(found.squared == expected.squared);
            if (n > 0)
                CHECK(boxes[std::size_t(found.item)].squared_distance(point) == found.squared);
        }
    }
}

TEST_CASE("the nearest item is found among random, coincident and aligned items") {
    std::vector<Box> same(3000, box_of({0.5, 0.5}, {0.1, 0.1})), line;
    for (int k = 0; k < 3000; ++k) line.push_back(box_of({0.25, 1.0 - k / 3000.0}, {0, 0}));
    for (std::vector<Box> const& boxes :
         {random_boxes(3000, 1), random_boxes(3000, 2, 0.25), same, line}) {
        Tree const tree(boxes);
        std::vector<int> seen(boxes.size(), 0);
        for (BoxTree::Entry const& entry : tree.tree().entry) ++seen[std::size_t(entry.item)];
        CHECK(seen == std::vector<int>(boxes.size(), 1));
        std::mt19937 random(9);
        for (int k = 0; k < 200; ++k) {
            Vec2 const point{2 * uniform(random) - 0.5, 2 * uniform(random) - 0.5};
            CHECK(tree.nearest(point).squared == by_looking(boxes, point).squared);
        }
    }
}

TEST_CASE("few items are examined, and none that cannot be nearer than the best one") {
    std::vector<Box> boxes;
    for (int k = 0; k < 40000; ++k)
        boxes.push_back(box_of({(k % 200) / 200.0, (k / 200) / 200.0}, {0.004, 0.004}));
    Tree const tree(boxes);
    std::mt19937 random(5);
    int asked = 0;
    for (int k = 0; k < 500; ++k) {
        tree.nearest({uniform(random), uniform(random)});
        asked += tree.asked();
    }
    CHECK(asked < 500 * 20);
    CHECK(tree.nearest({10, 10}, {harmorph::none, 1.0}).item == harmorph::none);
    CHECK(tree.asked() == 0);
    Nearest const start{7, 0};
    CHECK(tree.nearest({0.5, 0.5}, start).item == 7);
    CHECK(tree.asked() == 0);
}
