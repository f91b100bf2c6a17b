#include "morph/cell_bounds.hpp"

#include "base/vec2.hpp"
#include "morph/cell_batch.hpp"
#include "morph/odd_cells.hpp"

namespace harmorph {
namespace {

// A face beside the foot of an edge. The weight and the direction are those of the start.
struct LayerFace {
    Index from = none, to = none;
    Real weight = 1;
    Vec2 before;  // of length 1
    Vec2 now;     // the vector along the face

    bool given() const noexcept { return from != none && to != none; }
};

// One edge now and at the start. Vectors are complex numbers. With the directions o of the faces at
// the start and u now, the wall rotates by T = S / |S|, S = sum of weight conj(o) u; the edge E,
// rotated back, is e = conj(T) E. Then the ratio of heights is Re(conj(n) e) / (height at the
// start), n the normal at the start, and the cosine is Re(conj(E at the start) e) / (the lengths of
// both).
struct LayerState {
    LayerEdge edge;
    LayerFace face[2];
    Vec2 sum;            // S
    Vec2 rotation;       // T
    Vec2 old_edge, now;  // E
    Vec2 normal;
    Real old_height;

    LayerState(LayerEdge const& given, Points at, Points start) noexcept : edge(given) {
        face[0].from = edge.previous;
        face[0].to = face[1].from = edge.foot;
        face[1].to = edge.next;
        Vec2 along[2];
        for (Index k = 0; k < 2; ++k) {
            if (!face[k].given()) continue;
            along[k] = start[face[k].to] - start[face[k].from];
            face[k].before = direction(along[k]);
            face[k].now = at[face[k].to] - at[face[k].from];
        }
        Vec2 tangent = face[0].given() ? face[0].before : face[1].before;
        if (face[0].given() && face[1].given()) {
            face[0].weight = length(along[1]);
            face[1].weight = length(along[0]);
            tangent = face[0].weight * face[0].before + face[1].weight * face[1].before;
        }
        for (LayerFace const& wall : face) {
            if (wall.given())
                sum = sum + wall.weight * product(conjugate(wall.before), direction(wall.now));
        }
        rotation = direction(sum);
        if (rotation.x == 0 && rotation.y == 0) rotation = {1, 0};
        old_edge = start[edge.top] - start[edge.foot];
        now = at[edge.top] - at[edge.foot];
        normal = left_of(direction(tangent));
        old_height = dot(old_edge, normal);
    }

    Real value(LayerValue which) const noexcept {
        Vec2 const rotated_now = rotated_back(now, rotation);
        if (which == LayerValue::angle) return dot(direction(old_edge), direction(rotated_now));
        Real const ratio = dot(rotated_now, normal) / old_height;
        return which == LayerValue::stretch ? -ratio : ratio;
    }

    // Adds the derivatives of the value, multiplied by `scale`. `reference` is the vector of the
    // start with which the edge is compared, rotated with the wall.
    void add_slopes(LayerValue which, Real scale, PointGradient const& gradient) const noexcept {
        Vec2 by_edge;
        Real by_rotation = 0;
        if (which == LayerValue::angle) {
            Real const size = length(now);
            if (!(size > 0)) return;
            Vec2 const unit = direction(now), reference = rotated(direction(old_edge), rotation);
            // The value is the cosine of the angle between both unit vectors.
            Real const sine = cross(reference, unit);
            by_edge = -scale * sine / size * left_of(unit);
            by_rotation = scale * sine;
        } else {
            Vec2 const reference = rotated(normal, rotation);
            Real const factor = (which == LayerValue::stretch ? -scale : scale) / old_height;
            by_edge = factor * reference;
            by_rotation = factor * cross(reference, now);
        }
        gradient.add(edge.top, by_edge);
        gradient.add(edge.foot, -1 * by_edge);
        Real const size = length(sum);
        if (!(size > 0)) return;
        // The angle of T changes by Im(conj(T) dS) / |S|, and that of u by cross(u, d(now)) /
        // |now|.
        for (LayerFace const& wall : face) {
            Real const along = length(wall.now);
            if (!wall.given() || !(along > 0)) continue;
            Vec2 const unit = direction(wall.now), part = product(conjugate(wall.before), unit);
            Real const share = wall.weight * dot(rotation, part) / size;
            Vec2 const by_end = by_rotation * share / along * left_of(unit);
            gradient.add(wall.to, by_end);
            gradient.add(wall.from, -1 * by_end);
        }
    }
};

}  // namespace

SmoothMinimum find_layer_bound(Span<const LayerEdge> edges, LayerValue which, Real sharpness,
                               Points at, Points start, MutablePoints gradient) noexcept {
    SmoothMinimum found;
    found.sharpness = sharpness;
    for (LayerEdge const& edge : edges)
        found.note(LayerState(edge, at, start).value(which), edge.foot);
    found.shift = found.smallest;
    for (LayerEdge const& edge : edges)
        found.add(LayerState(edge, at, start).value(which), edge.foot);
    if (!gradient.given()) return found;
    PointGradient const all(gradient, 0, 2147483647);
    for (LayerEdge const& edge : edges) {
        LayerState const state(edge, at, start);
        Real const weight = found.weight(state.value(which)) / found.sum;
        if (weight > 0) state.add_slopes(which, weight, all);
    }
    return found;
}

namespace {

// Cells are divided into chunks, so many that threads share them evenly. A thread collects the
// derivatives by the points of its range, and computes all chunks that have such points: the sum at
// each point then has the order of the cells, whatever the number of threads. Where neighbouring
// cells have neighbouring points, few chunks are computed by several threads.
constexpr Index max_bound_chunks = 128, min_cells_in_bound_chunk = 1024;

struct BoundChunk {
    SmoothMinimum quality, area;
    Index first_point = 0, last_point = 0;
};

// The derivatives that one thread collects.
struct BoundGradients {
    PointGradient quality, area;
    bool wanted() const noexcept { return quality.wanted() || area.wanted(); }
};

struct BoundPass {
    OrientedMesh const& cells;
    CellPlaces places;
    SmoothRequest request;
    SmoothKernels const& kernels;

    void add_chunk(Index begin, Index end, BoundGradients const& gradients,
                   BoundChunk& chunk) const noexcept;
    // Adds cells of some batches. `numbers` are their numbers; null: those of the batches.
    void add_batches(CellBatches const& batches, const Index* numbers,
                     BoundGradients const& gradients, BoundChunk& chunk) const noexcept;
    void add_odd(Index cell, BoundGradients const& gradients, BoundChunk& chunk) const noexcept {
        OddCell const odd(cells, cell, places.at, places.reference);
        if (request.quality) odd.add_quality(request.kept, chunk.quality, gradients.quality);
        if (request.area) odd.add_areas(chunk.area, gradients.area);
    }
};

// Adds up the numbers of a list in eight sums, of which compilers make vectors.
Real sum_of_weights(const Real* numbers, Index n) noexcept {
    constexpr Index lanes = 8;
    Real sum[lanes] = {};
    Index i = 0;
    for (; i + lanes <= n; i += lanes) {
#pragma GCC unroll 8
        for (Index lane = 0; lane < lanes; ++lane) sum[lane] += numbers[i + lane];
    }
    for (Index lane = 0; i < n; ++i, ++lane) sum[lane] += numbers[i];
    return ((sum[0] + sum[1]) + (sum[2] + sum[3])) + ((sum[4] + sum[5]) + (sum[6] + sum[7]));
}
Real min_value_of(const Real* numbers, Index n) noexcept {
    constexpr Index lanes = 8;
    Real smallest[lanes];
    for (Real& number : smallest) number = infinity;
    Index i = 0;
    for (; i + lanes <= n; i += lanes) {
#pragma GCC unroll 8
        for (Index lane = 0; lane < lanes; ++lane)
            smallest[lane] = min(smallest[lane], numbers[i + lane]);
    }
    for (; i < n; ++i) smallest[0] = min(smallest[0], numbers[i]);
    Real overall = smallest[0];
    for (Index lane = 1; lane < lanes; ++lane) overall = min(overall, smallest[lane]);
    return overall;
}

// Replaces the numbers of odd cells, so that they add nothing. Returns the number of these cells.
Index clear_odd_cells(CellList const& cells, SmoothList& list, bool quality, bool area) noexcept {
    Index n = 0;
    for (std::uint64_t left = list.odd; left != 0; left &= left - 1) {
        Index const i = static_cast<Index>(__builtin_ctzll(left));
        if (i >= cells.n) break;
        ++n;
        if (quality) {
            list.quality[i] = infinity;
            list.quality_weight[i] = 0;
        }
        if (area) {
            list.area[i] = infinity;
            list.area_weight[i] = 0;
        }
    }
    return n;
}

template <Index width, bool unit>
void add_list_slopes(CellList const cells, const Real* weights, SmoothSlopes const& slopes,
                     PointGradient const gradient) noexcept {
    for (Index i = 0; i < cells.n; ++i) {
        if (weights[i] == 0) continue;  // the cell is odd, or too far from the smallest value
        const Index* const point = cells.point + width * i;
#pragma GCC unroll 4
        for (Index k = 0; k < width; ++k) {
            Index const corner = cells.reversed ? width - 1 - k : k;
            gradient.add<unit>(from_zero(point[corner], cells.index_base),
                               {slopes.x[k][i], slopes.y[k][i]});
        }
    }
}
void add_list_slopes(CellList const& cells, bool is_triangle, const Real* weights,
                     SmoothSlopes const& slopes, PointGradient const& gradient) noexcept {
    bool const unit = gradient.has_unit_stride();
    if (is_triangle && unit) add_list_slopes<3, true>(cells, weights, slopes, gradient);
    else if (is_triangle) add_list_slopes<3, false>(cells, weights, slopes, gradient);
    else if (unit) add_list_slopes<4, true>(cells, weights, slopes, gradient);
    else add_list_slopes<4, false>(cells, weights, slopes, gradient);
}

void BoundPass::add_batches(CellBatches const& batches, const Index* numbers,
                            BoundGradients const& gradients, BoundChunk& chunk) const noexcept {
    SmoothList lists[2];  // triangles, quads
    kernels.triangles(batches.triangles, places, request, lists[0]);
    kernels.quads(batches.quads, places, request, lists[1]);
    Real min_quality = infinity, min_area = infinity;
    for (Index kind = 0; kind < 2; ++kind) {
        CellList const& given = kind == 0 ? batches.triangles : batches.quads;
        SmoothList& list = lists[kind];
        if (given.n == 0) continue;
        bool const is_triangle = kind == 0;
        Index n_odd = 0;
        if (list.odd != 0) n_odd = clear_odd_cells(given, list, request.quality, request.area);
        Index const n_regular = given.n - n_odd;
        if (request.quality) {
            min_quality = min(min_quality, min_value_of(list.quality, given.n));
            chunk.quality.sum += sum_of_weights(list.quality_weight, given.n);
            chunk.quality.count += n_regular;
            if (gradients.quality.wanted())
                add_list_slopes(given, is_triangle, list.quality_weight, list.by_quality,
                                gradients.quality);
        }
        if (request.area) {
            min_area = min(min_area, min_value_of(list.area, given.n));
            chunk.area.sum += sum_of_weights(list.area_weight, given.n);
            chunk.area.count += std::int64_t{n_regular} * (is_triangle ? 1 : 4);
            if (gradients.area.wanted())
                add_list_slopes(given, is_triangle, list.area_weight, list.by_area, gradients.area);
        }
    }
    bool const is_smaller = min_quality < chunk.quality.smallest || min_area < chunk.area.smallest;
    if (!is_smaller && (lists[0].odd | lists[1].odd) == 0) return;
    batches.for_each([&](Index at, bool is_triangle, Index i) {
        Index const cell = numbers == nullptr ? at : numbers[at - batches.first];
        SmoothList const& list = lists[is_triangle ? 0 : 1];
        if ((list.odd >> i & 1) != 0) return add_odd(cell, gradients, chunk);
        if (request.quality) chunk.quality.note(list.quality[i], cell);
        if (request.area) chunk.area.note(list.area[i], cell);
    });
}

void BoundPass::add_chunk(Index begin, Index end, BoundGradients const& gradients,
                          BoundChunk& chunk) const noexcept {
    if (!cells.mesh.has_pieces()) {
        return for_each_batch(cells, begin, end, [&](CellBatches const& batches) {
            add_batches(batches, nullptr, gradients, chunk);
        });
    }
    // Polygons with three or four corners are not divided into pieces.
    Index numbers[CellBatches::max_count];
    CellBatches batches;
    batches.begin_copies(0);
    auto const finish = [&] {
        if (batches.n > 0) add_batches(batches, numbers, gradients, chunk);
        batches.begin_copies(0);
    };
    for (Index number = begin; number < end; ++number) {
        IndexRange const pieces = cells.mesh.pieces_of(number);
        if (pieces.count() > 1) {
            add_odd(number, gradients, chunk);
            continue;
        }
        numbers[batches.n] = number;
        batches.add_copy(cells.cell(pieces.first), false);
        if (batches.n == CellBatches::max_count) finish();
    }
    finish();
}

// Finds the smallest and the largest point of the cells of a chunk.
void find_chunk_points(OrientedMesh const& cells, Index begin, Index end,
                       BoundChunk& chunk) noexcept {
    Index first = cells.mesh.n_points, last = -1;
    auto const include = [&](Cell const& cell) {
        for (Index k = 0; k < cell.n; ++k) {
            first = min(first, cell.point[k]);
            last = max(last, cell.point[k]);
        }
    };
    if (cells.mesh.has_pieces()) {
        for (Index number = begin; number < end; ++number) {
            for (Index const piece : cells.mesh.pieces_of(number)) include(cells.mesh.cell(piece));
        }
    } else {
        cells.mesh.for_each_cell(begin, end, [&](Index, Cell const& cell) { include(cell); });
    }
    chunk.first_point = first;
    chunk.last_point = last;
}

// Computes the sums of all cells, and the derivatives of the sums by the points.
void run_pass(BoundPass const& pass, Executor const& executor, CellBoundPair& bounds) noexcept {
    OrientedMesh const& cells = pass.cells;
    Index const n_cells = cells.mesh.n_given_cells(), n_points = cells.mesh.n_points;
    Index const n_chunks = clamp(n_cells / min_cells_in_bound_chunk, Index{1}, max_bound_chunks);
    auto const start_of = [&](Index chunk) {
        return static_cast<Index>(Offset{n_cells} * chunk / n_chunks);
    };
    BoundChunk empty;
    empty.quality.sharpness = pass.request.quality_sharpness;
    empty.quality.shift = pass.request.quality_shift;
    empty.area.sharpness = pass.request.area_sharpness;
    empty.area.shift = pass.request.area_shift;
    BoundChunk chunks[max_bound_chunks];
    BoundGradients const wanted{{bounds.quality.gradient, 0, n_points},
                                {bounds.area.gradient, 0, n_points}};
    if (!wanted.wanted() || executor.is_serial()) {
        executor.for_each(n_chunks, [&](Index i) {
            chunks[i] = empty;
            pass.add_chunk(start_of(i), start_of(i + 1), wanted, chunks[i]);
        });
    } else {
        executor.for_each(n_chunks, [&](Index i) {
            chunks[i] = empty;
            find_chunk_points(cells, start_of(i), start_of(i + 1), chunks[i]);
        });
        executor.for_each(executor.n_threads, [&](Index thread) {
            Index const begin = static_cast<Index>(Offset{n_points} * thread / executor.n_threads),
                        end = static_cast<Index>(Offset{n_points} * (thread + 1) /
                                                 executor.n_threads);
            BoundGradients const part{{bounds.quality.gradient, begin, end},
                                      {bounds.area.gradient, begin, end}};
            for (Index i = 0; i < n_chunks; ++i) {
                if (chunks[i].last_point < begin || chunks[i].first_point >= end) continue;
                // The thread with the first point of a chunk keeps the sums of the chunk.
                bool const is_first = chunks[i].first_point >= begin;
                BoundChunk other = empty;
                pass.add_chunk(start_of(i), start_of(i + 1), part, is_first ? chunks[i] : other);
            }
        });
    }
    for (Index i = 1; i < n_chunks; ++i) {
        chunks[0].quality.merge(chunks[i].quality);
        chunks[0].area.merge(chunks[i].area);
    }
    bounds.quality.found = chunks[0].quality;
    bounds.area.found = chunks[0].area;
}

}  // namespace

// The first pass uses shifts that suit most meshes. If the smallest value is too far from one, the
// cells are visited again with the smallest value as the shift.
void find_cell_bounds(OrientedMesh const& cells, Points at, Points start, Executor const& executor,
                      CellBoundPair& bounds) noexcept {
    Index const n_points = cells.mesh.n_points;
    SmoothKernels const& kernels = smooth_kernels(executor.kernel, cells.mesh.n_cells);
    SmoothRequest request;
    request.quality = bounds.quality.sharpness > 0;
    request.kept = bounds.kept;
    request.area = bounds.area.sharpness > 0;
    request.slopes = bounds.quality.gradient.given() || bounds.area.gradient.given();
    request.quality_sharpness = bounds.quality.sharpness;
    request.area_sharpness = bounds.area.sharpness;
    request.quality_shift = bounds.kept ? 1 : 0.5;
    request.area_shift = 1;
    run_pass({cells, {at, {}, start}, request, kernels}, executor, bounds);
    bool const quality_again = request.quality && !bounds.quality.found.is_accurate(),
               area_again = request.area && !bounds.area.found.is_accurate();
    if (quality_again || area_again) {
        if (quality_again) request.quality_shift = bounds.quality.found.smallest;
        if (area_again) request.area_shift = bounds.area.found.smallest;
        clear_gradient(bounds.quality.gradient, n_points);
        clear_gradient(bounds.area.gradient, n_points);
        run_pass({cells, {at, {}, start}, request, kernels}, executor, bounds);
    }
    if (request.quality)
        scale_gradient(bounds.quality.gradient, n_points, 1 / bounds.quality.found.sum, executor);
    if (request.area)
        scale_gradient(bounds.area.gradient, n_points, 1 / bounds.area.found.sum, executor);
}

void MeshQuality::lay_out(Arena& arena, Basis const& basis, Mesh const& mesh) noexcept {
    Size const n_faces = static_cast<Size>(basis.faces().count());
    arena.take(xy, 2 * static_cast<Size>(mesh.n_points));
    arena.take(edge, WallPoints::max_count(mesh.n_points, n_faces));
    auto const mark = arena.mark();
    layer_.lay_out(arena, mesh, n_faces);
    arena.take(wall_face_, n_faces);
    arena.take(representative_, mesh.n_points);
    arena.take(is_wall_, mesh.n_points);
    arena.release(mark);
}

void MeshQuality::find(Basis const& basis, OrientedMesh const& mesh, Points at) noexcept {
    cells = mesh;
    Index const n_points = cells.mesh.n_points;
    for (Index k = 0; k < n_points; ++k) {
        xy[k] = at[k].x;
        xy[n_points + k] = at[k].y;
        representative_[k] = k;
    }
    fill(is_wall_, std::uint8_t{0});
    for (Index const point : basis.wall_point) is_wall_[point] = 1;
    for (Index k = 0; k < basis.joined_point.count(); ++k) {
        is_wall_[basis.joined_point[k]] = 1;
        representative_[basis.joined_point[k]] = basis.wall_point[basis.joined_slot[k]];
    }
    Index n_walls = 0;
    BoundaryFaces const faces = basis.faces();
    for (Index face = 0; face < faces.count(); ++face) {
        Index const from = faces.begin_of(face), to = faces.end_of(face);
        if (is_wall_[from] != 0 && is_wall_[to] != 0)
            wall_face_[n_walls++] = {{representative_[from], representative_[to]}};
    }
    layer_.find(cells.mesh, start(), representative_, wall_face_.first(n_walls));
    n_edges = 0;
    WallPoints const& wall = layer_.wall;
    for (Index slot = 0; slot < wall.count; ++slot) {
        if (layer_.above[slot] == none) continue;
        edge[n_edges++] = {wall.point[slot], layer_.above[slot], wall.previous[slot],
                           wall.next[slot]};
    }
}

}  // namespace harmorph
