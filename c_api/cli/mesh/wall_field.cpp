#include "mesh/wall_field.hpp"

#include "basics/numbers.hpp"
#include "basics/text_file.hpp"

namespace cli {

WallField read_wall_field(const std::string& path, const Mesh& mesh) {
    const TextFile file(path);
    LineReader lines(file, '#');
    WallField field;
    while (lines.next()) {
        const auto& words = lines.words();
        std::int32_t point = 0;
        double d[2] = {0, 0};
        if (words.size() != 3) lines.expected("point dx dy");
        if (!parse(words[0], point) || point < 0 || point >= mesh.points()) {
            lines.expected("a point between 0 and " + std::to_string(mesh.points() - 1), words[0]);
        }
        for (std::size_t i = 0; i < 2; ++i) {
            if (!parse(words[i + 1], d[i])) lines.expected("a finite number", words[i + 1]);
        }
        field.points.push_back(point);
        field.x.push_back(d[0]);
        field.y.push_back(d[1]);
    }
    return field;
}

}  // namespace cli
