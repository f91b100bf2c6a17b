// usage: make_family FOLDER COUNT SEED
// Writes COUNT airfoil files of tests/fixtures/section_families.hpp, 25 to 200 points each, and the
// file `list`.
#include <fixtures/section_families.hpp>

#include <cstdio>
#include <cstdlib>
#include <string>

int main(int argc, char** argv) {
    if (argc != 4) return 2;
    std::string const folder = argv[1];
    fixtures::SectionRandom random(std::strtoull(argv[3], nullptr, 10));
    std::FILE* const list = std::fopen((folder + "/list").c_str(), "w");
    if (list == nullptr) return 1;
    for (int number = 0; number < std::atoi(argv[2]); ++number) {
        std::string const name = "section-" + std::to_string(number) + ".dat";
        std::FILE* const file = std::fopen((folder + "/" + name).c_str(), "w");
        if (file == nullptr) return 1;
        std::fprintf(file, "section\n");
        for (fixtures::Point const& p : fixtures::section_to_fit(number, random))
            std::fprintf(file, "%.8f %.8f\n", p.x, p.y);
        std::fclose(file);
        std::fprintf(list, "%s\n", name.c_str());
    }
    std::fclose(list);
    return 0;
}
