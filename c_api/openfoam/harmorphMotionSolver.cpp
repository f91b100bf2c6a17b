#include "harmorphMotionSolver.hpp"

#include "addToRunTimeSelectionTable.H"
#include "Enum.H"

namespace Foam {

defineTypeNameAndDebug(harmorphMotionSolver, 0);
addToRunTimeSelectionTable(motionSolver, harmorphMotionSolver, dictionary);
addToRunTimeSelectionTable(displacementMotionSolver, harmorphMotionSolver, displacement);

namespace {

const Enum<int> operators({{HM_CONFORMAL, "conformal"},
                           {HM_LAPLACE, "laplace"},
                           {HM_WEIGHTED, "weighted"}});

IOobject reference_file(const polyMesh& mesh) {
    return IOobject("harmorphReference", mesh.time().timeName(), mesh, IOobject::READ_IF_PRESENT,
                    IOobject::AUTO_WRITE);
}

// The library's default is 0, and no weight a negative exponent.
scalar exponent_of(const dictionary& coefficients) {
    if (!coefficients.found("exponent")) return 0;
    const scalar exponent = coefficients.get<scalar>("exponent");
    if (exponent < 0 || exponent > 4 || std::fmod(exponent, 0.25) != 0) {
        FatalIOErrorInFunction(coefficients)
            << "The exponent " << exponent << " is not a multiple of 0.25 from 0 to 4."
            << exit(FatalIOError);
    }
    return exponent == 0 ? -1 : exponent;
}

scalar not_negative(const dictionary& coefficients, const word& name, scalar usual) {
    const scalar value = coefficients.getOrDefault<scalar>(name, usual);
    if (value < 0) {
        FatalIOErrorInFunction(coefficients) << "The coefficient " << name << " is " << value
                                             << ", but must not be negative." << exit(FatalIOError);
    }
    return value;
}

// Without harmorphCoeffs, the coefficients stand among the entries of dynamicMeshDict.
void refuse_unknown(const dictionary& coefficients) {
    if (coefficients.dictName() != word(harmorphMotionSolver::typeName + "Coeffs")) return;
    const wordHashSet known(
        {"patches", "slip", "operator", "exponent", "refactor", "safe", "improve", "report"});
    for (const word& name : coefficients.toc()) {
        if (known.found(name)) continue;
        FatalIOErrorInFunction(coefficients)
            << "The coefficient " << name << " is unknown. The coefficients are "
            << known.sortedToc() << exit(FatalIOError);
    }
}

}  // namespace

harmorphMotionSolver::harmorphMotionSolver(const polyMesh& mesh, const IOdictionary& dict)
    : displacementMotionSolver(mesh, dict, typeName),
      reference_(reference_file(mesh), pointMesh::New(mesh), dimensionedVector(dimLength, Zero)) {}

harmorphMotionSolver::harmorphMotionSolver(const polyMesh& mesh, const IOdictionary& dict,
                                           const pointVectorField& displacement,
                                           const pointIOField& points0)
    : displacementMotionSolver(mesh, dict, displacement, points0, typeName),
      reference_(reference_file(mesh), pointMesh::New(mesh), dimensionedVector(dimLength, Zero)) {}

MotionSettings harmorphMotionSolver::settings() const {
    const dictionary& coefficients = coeffDict();
    MotionSettings settings;
    HM_INIT(settings.options);
    settings.options.operator_kind = operators.getOrDefault("operator", coefficients, HM_CONFORMAL);
    settings.options.exponent = exponent_of(coefficients);
    settings.safe = coefficients.getOrDefault("safe", true);
    settings.improve = not_negative(coefficients, "improve", 0);
    settings.refactor = not_negative(coefficients, "refactor", 2);
    return settings;
}

void harmorphMotionSolver::begin() {
    if (!moveAllCells()) {
        FatalErrorInFunction << "The motion solver harmorph moves the whole mesh; cellZone and "
                                "cellSet are not available."
                             << exit(FatalError);
    }
    const dictionary& coefficients = coeffDict();
    refuse_unknown(coefficients);
    report_interval_ = coefficients.getOrDefault<label>("report", 0);
    patches_ =
        std::make_unique<PatchConditions>(pointDisplacement_, coefficients.get<wordRes>("patches"),
                                          coefficients.getOrDefault<wordRes>("slip", wordRes()));
    gathered_ = std::make_unique<GatheredMesh>(mesh(), points0());
    const MotionSettings chosen = settings();
    if (Pstream::master())
        motion_ = std::make_unique<PlaneMotion>(mesh(), *gathered_, *patches_, chosen);
    restore();
}

// Fields that were read at a restart come back; at a start they are 0.
void harmorphMotionSolver::restore() {
    std::vector<vector> now(static_cast<std::size_t>(gathered_->size()), Zero), reference(now);
    const labelList all(identity(mesh().nPoints()));
    gathered_->gather({all, pointDisplacement_.primitiveField()}, now, nullptr);
    gathered_->gather({all, reference_.primitiveField()}, reference, nullptr);
    if (motion_) motion_->restore(now, reference);
}

void harmorphMotionSolver::solve() {
    if (!gathered_) begin();
    patches_->update(pointDisplacement_);
    patches_->require_fixed(pointDisplacement_);
    std::vector<vector> wall(static_cast<std::size_t>(gathered_->size()), Zero);
    std::vector<char> is_given(wall.size());
    gathered_->gather(patches_->given(pointDisplacement_), wall, &is_given);
    bool factored = false;
    if (motion_) {
        motion_->move(wall, is_given);
        factored = motion_->report().factored;
    }
    const std::vector<vector> none;
    pointDisplacement_.primitiveFieldRef() = gathered_->scatter(motion_ ? motion_->now() : none);
    reduce(factored, orOp<bool>());
    if (factored)
        reference_.primitiveFieldRef() = gathered_->scatter(motion_ ? motion_->reference() : none);
    if (motion_ && report_interval_ > 0 && n_solved_ % report_interval_ == 0) report();
    ++n_solved_;
}

tmp<pointField> harmorphMotionSolver::curPoints() const {
    return points0() + pointDisplacement_.primitiveField();
}

void harmorphMotionSolver::report() const {
    const MotionReport& found = motion_->report();
    const hm_quality_report& quality = found.judgement.quality;
    Info << "harmorph: smallest quality " << quality.min_quality << " at " << found.worst
         << " of points0, mean quality " << quality.mean_quality;
    if (found.factored) Info << ", factored again";
    if (found.stepped_safely) Info << ", by safe steps";
    if (found.improved) Info << ", improved";
    Info << endl;
}

void harmorphMotionSolver::updateMesh(const mapPolyMesh&) {
    FatalErrorInFunction << "The motion solver harmorph cannot follow changes of the topology: the "
                            "functions belong to one mesh."
                         << exit(FatalError);
}

}  // namespace Foam
