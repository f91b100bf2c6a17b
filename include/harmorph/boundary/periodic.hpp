// Periodic pairs: two boundaries, one of which is the other moved by a translation. Their points move alike.
#pragma once

#include "harmorph/boundary/conditions.hpp"
#include "harmorph/mesh/periodic_translations.hpp"

namespace harmorph {

// Ties every point of a periodic partner to the image: both have one representative from now on, and the kind of higher
// precedence. tangent: of slip lines, or empty. chain [points on boundaries]: working space. Refuses pairs that are not
// one piece each or not translates of each other, walls that end on them, and translations that form no lattice.
Status tie_periodic(Topology& topology, Boundary const& boundary, Span<const Condition> conditions, Span<Index> chain,
                    Span<PointKind> kinds, Span<Vec2> tangent, Translations& translations, Fault& fault) noexcept;

}  // namespace harmorph
