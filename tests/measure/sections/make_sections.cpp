// usage: make_sections FOLDER COUNT
// Writes COUNT airfoil files of all families of tests/fixtures/section_families.hpp in turn, in all
// orders in which such files come, and the file `list` with their names.
#include <fixtures/section_families.hpp>

#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

using fixtures::Point;
using fixtures::SectionSides;

enum Order { selig, backwards, lednicer, open_end, twice_in_front, orders };

constexpr const char* order_names[] = {"selig", "backwards", "lednicer", "open_end",
                                       "twice_in_front"};

void put(std::FILE* file, Point const& p, int digits) {
    std::fprintf(file, " %.*f %.*f\n", digits, p.x, digits, p.y);
}

void write(std::FILE* file, SectionSides const& sides, Order order, int digits) {
    std::fprintf(file, "section\n");
    if (order == lednicer) {
        std::fprintf(file, " %zu. %zu.\n\n", sides.upper.size(), sides.lower.size());
        for (Point const& p : sides.upper) put(file, p, digits);
        std::fprintf(file, "\n");
        for (Point const& p : sides.lower) put(file, p, digits);
        return;
    }
    std::vector<Point> const &first = order == backwards ? sides.lower : sides.upper,
                             &second = order == backwards ? sides.upper : sides.lower;
    for (std::size_t k = first.size(); k-- > 0;) put(file, first[k], digits);
    std::size_t const begin = order == twice_in_front ? 0 : 1;
    bool const drops_end = order == open_end && !sides.is_blunt();
    for (std::size_t k = begin; k + (drops_end ? 1 : 0) < second.size(); ++k)
        put(file, second[k], digits);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) return 2;
    std::string const folder = argv[1];
    std::FILE* const list = std::fopen((folder + "/list").c_str(), "w");
    if (list == nullptr) return 1;
    constexpr int points[] = {25, 40, 60, 100};
    constexpr double clusterings[] = {0.3, 0.8, 1};
    constexpr int families = static_cast<int>(fixtures::Family::count);
    for (int k = 0; k < std::atoi(argv[2]); ++k) {
        fixtures::SectionRandom random(static_cast<std::uint64_t>(k));
        auto const family = static_cast<fixtures::Family>(k % families);
        auto const order = static_cast<Order>(random.whole(0, orders - 1));
        int const digits = random.whole(5, 8), n = points[random.whole(0, 3)];
        double const clustering = clusterings[random.whole(0, 2)];
        auto const sides =
            fixtures::rounded(fixtures::random_section(family, random, n, clustering), digits);
        std::string const name = std::string(fixtures::family_name(family)) + "-" +
                                 order_names[order] + "-" + std::to_string(k) + ".dat";
        std::FILE* const file = std::fopen((folder + "/" + name).c_str(), "w");
        if (file == nullptr) return 1;
        write(file, sides, order, digits);
        if (std::fclose(file) != 0) return 1;
        std::fprintf(list, "%s\n", name.c_str());
    }
    return std::fclose(list) != 0;
}
