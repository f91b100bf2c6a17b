// The extension of the path selects the format of a curve file.
#include "curves/cad_curves.hpp"
#include "curves/curve_file.hpp"
#include "curves/section.hpp"

#include <algorithm>
#include <cctype>

namespace cli {

bool ends_with(const std::string& path, const std::string& ending) {
    const auto same = [](char a, char b) {
        return std::tolower(static_cast<unsigned char>(a)) == b;
    };
    if (path.size() < ending.size()) return false;
    return std::equal(ending.rbegin(), ending.rend(), path.rbegin(),
                      [&](char b, char a) { return same(a, b); });
}

void write_curve_file(OutputFiles& files, const std::string& path, const Curves& curves) {
    std::ostream& out = files.add(path);
    if (ends_with(path, ".igs") || ends_with(path, ".iges")) return write_iges(out, curves);
    if (ends_with(path, ".stp") || ends_with(path, ".step")) return write_step(out, curves);
    if (ends_with(path, ".nml")) return write_namelist(out, curves);
    if (ends_with(path, ".dat")) return write_selig(out, curves);
    write_curves(out, curves);
}

}  // namespace cli
