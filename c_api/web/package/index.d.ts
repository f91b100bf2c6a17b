// harmorph morphs an airfoil and the CFD mesh around the airfoil together. Lengths have the unit of the coordinates,
// angles are in degrees; points, cells, control points, curves and functions are counted from 0.
import type {
    BasisInfo, FitReport, ImproveReport, MeshReport, QualityReport, RefitReport, SafeReport, SolveReport, StepReport,
} from "./reports.js";
export * from "./reports.js";

declare global {
    interface SymbolConstructor {
        readonly dispose: unique symbol;
    }
}

/** What a call reads: a Float64Array, Numbers (read in place, without a copy), or an array of numbers. */
export type NumbersIn = Float64Array | Float32Array | Numbers | readonly number[];
/** What a call writes: a Float64Array, or Numbers (written in place, without a copy). */
export type NumbersOut = Float64Array | Numbers;
export type Integers = Int32Array | Uint32Array | readonly number[];
export type Pair = readonly [number, number];

/** A call was refused; outputs are as before the call. `onWarning` receives the same fields for reservations. */
export class HarmorphError extends Error {
    /** The name of the status in the C header, for instance "HM_BAD_MESH". */
    code: string;
    /** What `item` counts: "point", "cell", "marker", "control point", ...; null: nothing. */
    kind: string | null;
    /** The first offending item, counted from 0 (markers: the number of the marker). */
    item: number | null;
    /** A second item that the error is about. */
    otherKind: string | null;
    other: number | null;
    /** The value found: area [length^2], residual, missing or needed bytes; or 0. */
    value: number;
    /** The place that the sentence names [length]; 0, 0: none. */
    x: number;
    y: number;
}

/** Memory of the module is given back by free(), by `using`, or some time after the object is collected. */
interface Owner {
    free(): void;
    [Symbol.dispose](): void;
}

export type Marker = string | number;

/** An object or a Map; markers that are numbers need a Map. */
export type ByMarker<T> = Record<string, T> | Map<Marker, T>;

export type Cells =
    | { triangles?: Integers; quads?: Integers }
    /** Compressed rows: cell k has the points points[start[k]] .. points[start[k + 1] - 1]. */
    | { start: Integers; points: Integers; polygons?: boolean }
    /** Point (i, j) is i + ni * j. */
    | { ni: number; nj: number }
    /** Structured blocks, one after the other; their interfaces are cuts. */
    | { blocks: readonly Pair[] };

/** A run of points in order along the boundary, the first one repeated at the end of a loop; or edges. */
export type BoundaryPoints = Integers | { edges: Integers };

export class Mesh implements Owner {
    /**
     * Copies a mesh into the memory of the module.
     * @param points pairs x, y, x, y, ... in any unit of length
     * @param cells points of the cells, in order around each cell; a quadrilateral that repeats its last point is a
     *     triangle
     * @param boundary points by marker; edges without a marker must form cuts
     */
    constructor(points: NumbersIn, cells: Cells, boundary: ByMarker<BoundaryPoints>);
    readonly nPoints: number;
    readonly nCells: number;
    /** The number of each marker in the library. Names have the smallest free numbers, in the order of the names. */
    readonly markers: Map<Marker, number>;
    /** The coordinates: a view of the memory, which may be written. Take it again after calls: memory may grow. */
    readonly points: Float64Array;
    /** Checks the mesh and counts what is in it; refuses what Morph refuses, except for inverted cells. */
    report(): MeshReport;
    /** Points of markers in order along the boundary, the mesh on the left: around a body clockwise. */
    wall(markers: Marker | readonly Marker[], piece?: number): { points: Int32Array; isLoop: boolean };
    free(): void;
    [Symbol.dispose](): void;
}

export interface Curve {
    /** 1 to 5. */
    degree: number;
    /** Non-decreasing; one for each index, and degree + 1. */
    knots: Float64Array;
    /** Control points, repeated ones counted again. */
    indices: Int32Array;
}

export interface FitOptions {
    /** Control points of each piece; default 20. */
    nControl?: number;
    /** 1 to 5; default 3. */
    degree?: number;
    /** "auto": periodic without corners, open with a second curve along a blunt base, otherwise tied. */
    closed?: "auto" | "open" | "tied" | "periodic";
    /** One for each point of the mesh, or of the list. */
    weights?: NumbersIn;
    /** [length] Waves shorter than this are damped. */
    smoothing?: number;
    /** [length] Control points are inserted up to this error, at most nControl. */
    tolerance?: number;
    /** Directions of the curve at its ends. */
    begin?: Pair;
    end?: Pair;
}

export type QuantityKind =
    | "area" | "centroidX" | "centroidY" | "momentXx" | "momentYy" | "momentXy" | "chord" | "thickness" | "camber"
    | "maxThickness" | "maxCamber" | "leadingEdgeRadius" | "trailingEdgeAngle" | "trailingEdgeGap" | "minRadius"
    | "curvatureVariation" | "clearance" | "twist" | "minThickness" | "distance";

/** harmorph_design.h defines all quantities. */
export type Quantity = QuantityKind | {
    kind: QuantityKind;
    station?: number;
    lastStation?: number;
    polygon?: NumbersIn;
    sharpness?: number;
    otherCurve?: number;
    nOther?: number;
};

/** B-spline curves with common control points: plain arrays, no memory of the module. */
export class Curves {
    constructor(
        control: NumbersIn,
        curves: readonly { degree: number; knots: NumbersIn; indices?: Integers }[],
        weights?: NumbersIn | null,
    );
    /** Pairs x, y [length]. */
    readonly control: Float64Array;
    readonly nControl: number;
    readonly weights: Float64Array | null;
    readonly curves: readonly Curve[];
    /** The markers that fit() was given; Morph puts them onto the curves. */
    markers: Marker[];
    readonly fitReport: FitReport | null;
    /** Fits curves to the points of markers of a mesh, each connected piece by its own. */
    static fit(mesh: Mesh, markers: Marker | readonly Marker[], options?: FitOptions): Curves;
    /** Fits curves to points in order. isLoop: the last point is connected to the first one, which is not repeated. */
    static fitPoints(points: NumbersIn, isLoop: boolean, options?: FitOptions): Curves;
    moved(move: NumbersIn): Curves;
    /** Points of a curve at parameters, or derivatives (0 to 5) by the parameter: pairs x, y. */
    points(u: NumbersIn, options?: { curve?: number; derivative?: number }): Float64Array;
    /** The first and the last parameter of a curve. */
    range(curve?: number): Pair;
    /** The parameter of the nearest point of a curve, and the distance [length]. */
    project(point: Pair, curve?: number): { u: number; distance: number };
    /**
     * Measures the section. gradients: for each quantity the derivatives by x and y of the control points.
     * chord: leading and trailing edge of a chord line that does not move; curves: the first curve and their number.
     */
    measure(
        quantities: Quantity | readonly Quantity[],
        options?: { chord?: readonly [Pair, Pair]; curves?: Pair },
    ): { values: Float64Array; gradients: Float64Array; places: Float64Array };
    /** The movement with which a curve becomes another airfoil, given by points in order along its outline. */
    refit(
        points: NumbersIn, isLoop: boolean, options?: { curve?: number; onChord?: boolean },
    ): { move: Float64Array; report: RefitReport };
    /** A gradient by the control points, smoothed along the curves; changes along less than `length` are damped. */
    smooth(gradient: NumbersIn, length: number): Float64Array;
}

export type ConditionKind =
    | "curve" | "rigid" | "fixed" | "slip" | "free" | "periodic" | "given" | "rotation" | "interface";

export type Condition = ConditionKind | {
    kind: ConditionKind;
    /** "curve": the first curve and the number of curves; default all. */
    curves?: Pair;
    /** "rigid": the number of the body, from 0. */
    body?: number;
    /** "periodic", "rotation", "interface": the other marker. */
    partner?: Marker;
    /** "rigid", "rotation": the centre of rotation [length]. */
    centre?: Pair;
    /** The condition is for one piece of the marker, the one nearest to this point. */
    near?: Pair;
    /** "slip": the curves along which the points move. */
    along?: Curves;
};

export interface MorphOptions {
    /** Conformal functions keep the angles at the wall; Laplace functions are those of the paper. */
    operator?: "conformal" | "laplace" | "weighted";
    engine?: "direct" | "multigrid" | "fas";
    scheme?: "compact" | "bounded" | "nodalGradient";
    /** q of the weight 1 / d^q, a multiple of 0.25 up to 4; 0: no weight. */
    exponent?: number;
    /** Conformal only: offsets of mesh points from the curve rotate with the curve. */
    offsetCorrection?: boolean;
    /** Relative residual above which the solution warns; 0 means 1e-10. */
    tolerance?: number;
    /** Points farther from their curve than this part of the diagonal of its box are refused; 0 refuses none. */
    maxCurveDistance?: number;
    /** Called at the start of each phase and in between; a result of false stops the call (HM_CANCELLED). */
    progress?: (phase: string, fraction: number) => boolean | void;
}

export interface SafeOptions {
    out?: NumbersOut;
    /** How many times the functions may be solved again; 0 means 10, negative never. */
    maxResolves?: number;
    skip?: readonly ("linear" | "other" | "substeps" | "untangled" | "improved")[];
    /** Of the same mesh, curves and conditions with other operators. */
    others?: readonly Morph[];
    /** The mesh at the target is improved in any case. */
    improve?: boolean;
    /** 0 to 1: the part of the heights of the first layer that is restored. */
    heights?: number;
    /** Smallest quality in parts of that of the start; 0 means 0.05, negative any valid mesh. */
    minQuality?: number;
    /** The largest factor by which heights of the first layer may change; 0: any. */
    maxHeightChange?: number;
}

export interface Safe {
    /** No cell is inverted. */
    points: NumbersOut;
    report: SafeReport;
    /** The movement that `points` has. */
    reached: Float64Array;
}

/** Results are new Float64Arrays, or `out` where it is given. Points are pairs x, y, x, y, ... */
export class Morph implements Owner {
    /**
     * Checks the mesh, factors the matrix and solves for one function for each control point. The mesh is copied.
     * Markers that `curves` was fitted to are on the curves; other markers without a condition are fixed.
     */
    constructor(
        mesh: Mesh,
        curves?: Curves | null,
        conditions?: ByMarker<Condition> | readonly (readonly [Marker, Condition])[],
        options?: MorphOptions,
    );
    readonly curves: Curves | null;
    /** Pairs of `move`: control points, then two pairs for each rigid body. */
    readonly functions: number;
    readonly nPoints: number;
    readonly info: BasisInfo;
    readonly solveReport: SolveReport | null;
    /** A copy of the coordinates on which the functions were solved. */
    readonly start: Float64Array | null;
    /** The displacement of each mesh point, sum_i F_i (dx, dy)_i. */
    displacement(move: NumbersIn, options?: { out?: NumbersOut }): NumbersOut;
    /** points + sum_i F_i (dx, dy)_i; points: default `start`; out may be points. */
    morph(move: NumbersIn, options?: { points?: NumbersIn; out?: NumbersOut }): NumbersOut;
    /** Derivatives by `move` from those by the mesh points: the exact transpose. */
    adjoint(dj: NumbersIn, options?: { out?: NumbersOut }): NumbersOut;
    /**
     * The functions as a dense array [planes][points][functions], for products elsewhere. With the planes F0, F1, ...
     * and movements px, py: 1 plane: F0 px, F0 py; 2 planes (complex): F0 px - F1 py, F1 px + F0 py; 4: F0 px + F1 py,
     * F2 px + F3 py.
     */
    matrix(options?: { out?: NumbersOut }): NumbersOut;
    /**
     * Judges a movement before anything moves, or a mesh as it is (null). With cells, true or an array for them, the
     * result has the quality of each cell, 0 for inverted cells.
     */
    assess(
        displacement?: NumbersIn | null,
        options?: { points?: NumbersIn; reference?: NumbersIn; cells?: boolean | NumbersOut },
    ): { step: StepReport | null; quality: QualityReport; cells: NumbersOut | null };
    /** The largest distance of wall points from where their conditions take them [length]. */
    boundaryError(move: NumbersIn, moved: NumbersIn, options?: { points?: NumbersIn }): number;
    /** The movement that a mesh has made since the functions were solved. */
    recover(points: NumbersIn, options?: { tolerance?: number }): Float64Array;
    /** Moves the mesh from `start` by a movement of any size, so that no cell inverts. */
    safe(move: NumbersIn, options?: SafeOptions): Safe;
    /** Makes the cells of a moved mesh more like those before; no cell inverts. */
    improve(
        points: NumbersIn, options?: { out?: NumbersOut; reference?: NumbersIn; maxSolutions?: number },
    ): { points: NumbersOut; report: ImproveReport };
    /** Puts points with slip back onto their curved boundary after a morph. */
    slip(points: NumbersIn, options?: { out?: NumbersOut }): NumbersOut;
    /** The wall points with the condition "given", in order. */
    readonly givenPoints: Int32Array;
    /** Carries displacements of wall points to the mesh, added to `points` if these are given. */
    displace(wall: NumbersIn, options?: { points?: NumbersIn; out?: NumbersOut; wallPoints?: Integers }): NumbersOut;
    /** The same for several fields at once. */
    displace(
        fields: readonly NumbersIn[], options?: { points?: NumbersIn; wallPoints?: Integers },
    ): Float64Array[];
    /** The transpose of displace(): forces on mesh points become forces on the wall. */
    displaceAdjoint(dj: NumbersIn, options?: { wallPoints?: Integers }): Float64Array;
    displaceAdjoint(fields: readonly NumbersIn[], options?: { wallPoints?: Integers }): Float64Array[];
    /** safe() for given displacements of wall points; move: of curves and rigid bodies in the same call. */
    displaceSafe(wall: NumbersIn, options?: SafeOptions & { move?: NumbersIn; wallPoints?: Integers }): Safe;
    /**
     * Solves again, on other coordinates of the mesh points, which become `start`. Functions of rigid bodies belong to
     * the first analysis: the second pair of a body is s - 1 there, s = scale (cos a, sin a), and then s_new - s_old.
     */
    solve(points?: NumbersIn): void;
    /** The bytes of a basis file, which C, Fortran, Python and the program read. */
    save(): Uint8Array;
    /**
     * Attaches a basis file; without the mesh there are displacement, morph with points, adjoint and matrix. The mesh
     * may have moved by the functions of the basis: solve() then makes functions of the mesh as it is, without which
     * safe() is refused. If the movement can be found, `curves` are those after it, and after solve() rigid bodies
     * turn about the places to which their centres have moved. Before solve(), recover() begins at the first analysis.
     */
    static load(bytes: Uint8Array, mesh?: Mesh | null): Morph;
    /** Gives analysis and plan back; calls that need them make them again. */
    release(): void;
    free(): void;
    [Symbol.dispose](): void;
}

export type BoundKind = "quality" | "keptQuality" | "area" | "height" | "stretch" | "angle";
export type Bound = BoundKind | { kind: BoundKind; sharpness?: number };

/** The mesh of a morph at its start, with which moved meshes are compared; the morph must not be freed before. */
export class Quality implements Owner {
    constructor(morph: Morph);
    /** Smooth bounds of the quality (harmorph_quality.h) and their derivatives by the mesh points [1/length]. */
    bounds(
        kinds: Bound | readonly Bound[],
        options?: { points?: NumbersIn; gradients?: boolean },
    ): { value: number; extreme: number; item: number; gradient: Float64Array | null }[];
    /** The corners that limit the admissible step, the smallest step first. */
    corners(
        displacement: NumbersIn, options?: { points?: NumbersIn; closeness?: number },
    ): { step: number; cell: number; points: number[]; byPoints: Float64Array }[];
    free(): void;
    [Symbol.dispose](): void;
}

/** n numbers in the memory of the module, 0 at first: calls read and write them without a copy. */
export class Numbers implements Owner {
    constructor(n: number);
    readonly length: number;
    /** A view of the memory. Take it again after calls: memory may grow. */
    readonly view: Float64Array;
    free(): void;
    [Symbol.dispose](): void;
}

export interface LoadOptions {
    /** "auto": simd128 where the engine has it. Both kernels give the same bits. */
    kernel?: "auto" | "baseline" | "simd128";
    /** A module of the package that was compiled or read before, for instance by another worker. */
    module?: WebAssembly.Module | BufferSource;
    /** Receives what can be used with a reservation; default: console.warn. null: nothing. */
    onWarning?: ((finding: HarmorphError) => void) | null;
}

/** The classes of one instance of the library, which has a memory of its own. */
export interface Harmorph {
    readonly version: string;
    readonly kernel: "baseline" | "simd128" | "given";
    /** Bytes that objects hold; the memory itself never shrinks. */
    readonly bytesInUse: number;
    readonly memory: WebAssembly.Memory;
    readonly Mesh: typeof Mesh;
    readonly Curves: typeof Curves;
    readonly Morph: typeof Morph;
    readonly Quality: typeof Quality;
    readonly Numbers: typeof Numbers;
    readonly HarmorphError: typeof HarmorphError;
}

/** Instantiates the library. The classes that it returns work with each other; other instances are apart. */
export function load(options?: LoadOptions): Promise<Harmorph>;
