// harmorph sample: many designs of one mesh, for surrogate models.
#include "basics/print.hpp"
#include "basics/progress.hpp"
#include "commands/commands.hpp"
#include "files/output_file.hpp"
#include "formats/format.hpp"
#include "sampling/sample_folder.hpp"
#include "sampling/sample_pages.hpp"
#include "sampling/sample_shard.hpp"
#include "sampling/sample_table.hpp"
#include "work/read_mesh.hpp"

#include <algorithm>
#include <memory>

namespace cli {

namespace {

constexpr const char* final_files[] = {"set.txt", "designs.csv", "index.html", "README.md",
                                       "vtk/series.pvd"};

class Sampling {
public:
    explicit Sampling(const Arguments& arguments)
        : arguments_(arguments),
          folder_(arguments.text("-o")),
          settings_(settings_of_set(arguments)),
          mesh_(read_mesh(arguments, 0)),
          basis_(arguments.operand(1), mesh_),
          space_(arguments, basis_),
          measures_(arguments, basis_.curves(),
                    arguments.whole("--airfoil-curve", 1, 1, basis_.info().curves) - 1),
          table_(space_, measures_.names(), arguments.has("--step")),
          limits_(arguments, names_of_limits()),
          splits_(arguments, table_.numbers()),
          threads_(threads_of(arguments)),
          morpher_(mesh_, basis_, threads_, arguments.real("--min-quality", .05, 0, 1),
                   arguments.has("--step")),
          per_shard_(arguments.whole("--shard", 1000, 1, 1000000)),
          files_(arguments, mesh_) {
        if (basis_.mesh_has_moved())
            throw Failure(exit_unusable, arguments.operand(0) +
                                             ": the mesh has moved since the basis was "
                                             "solved; solve again on this mesh");
        for (const char* const name : final_files)
            refuse_overwriting(arguments, {FileUse::output, "a file of -o,", folder_.file(name)});
        if (arguments.has("--wall")) walls_ = std::make_unique<WallChains>(mesh_, moving_markers());
        if (arguments.has("--wall-distance"))
            distances_ = std::make_unique<WallDistances>(mesh_, moving_markers(), threads_);
    }

    void run() {
        folder_.open(settings_, files_.has_meshes(), files_.has_vtk());
        shards_ = folder_.complete_shards();
        std::int64_t next = 0;
        if (shards_ > 0) {
            table_.read(folder_, shards_, [&](const SampleRow& row) { next = row.design + 1; });
            if (!arguments_.has("--json"))
                print("continued at design %lld of %lld\n", static_cast<long long>(next + 1),
                      static_cast<long long>(space_.count()));
        }
        begin_ = next;
        while (next < space_.count()) next = run_shard(next);
        finish();
    }

private:
    std::vector<std::string> names_of_limits() const {
        const auto begin = table_.numbers().begin();
        return {begin, begin + static_cast<std::ptrdiff_t>(table_.first_parameter())};
    }

    std::vector<std::int32_t> moving_markers() const {
        std::vector<std::int32_t> markers;
        for (const hm_condition& one : basis_.conditions())
            if (one.kind == HM_ON_CURVE || one.kind == HM_RIGID) markers.push_back(one.marker);
        return markers;
    }

    std::size_t batch_size() const {
        constexpr std::size_t numbers = std::size_t{1} << 23;  // 64 MiB of coordinates
        const std::size_t fitting = numbers / (6 * mesh_.x.size() + 1);
        const auto threads = static_cast<std::size_t>(threads_of(arguments_));
        if (threads == 1) return 1;  // so that the design stays in the cache until it is written
        return std::clamp<std::size_t>(fitting, threads, 32 * threads);
    }

    // Makes the designs that follow the given one until a shard is full. Returns the next design.
    std::int64_t run_shard(std::int64_t next) {
        SampleShard shard(folder_, shards_ + 1, mesh_, table_, walls_.get(), distances_.get());
        while (next < space_.count() && shard.accepted() < per_shard_) {
            batch_.resize(static_cast<std::size_t>(
                std::min<std::int64_t>(space_.count() - next, std::int64_t(batch_size()))));
            compute(batch_, next);
            for (MorphedDesign& result : batch_) {
                if (shard.accepted() == per_shard_) break;  // the rest belongs to the next shard
                take(shard, result, next++);
            }
            draw(next);
        }
        shard.commit();
        ++shards_;
        return next;
    }

    struct Batch {
        const Sampling* self;
        std::vector<MorphedDesign>* results;
        std::int64_t first;
    };

    static void compute_one(void* context, std::int32_t index) {
        const Batch& batch = *static_cast<Batch*>(context);
        MorphedDesign& result = (*batch.results)[static_cast<std::size_t>(index)];
        try {
            batch.self->compute(result, batch.first + index);
        } catch (...) {
            result.fault = std::current_exception();
        }
    }

    void compute(MorphedDesign& result, std::int64_t number) const {
        result.begin();
        try {
            result.design = space_.design(number);
        } catch (const Failure& failure) {
            if (!space_.has_sections()) throw;
            result.refusal = failure.what();
            return;
        }
        morpher_.morph_linearly(result);
        result.measures = measures_.values(basis_.curves(), result.control);
    }

    void compute(std::vector<MorphedDesign>& batch, std::int64_t first) const {
        Batch context = {this, &batch, first};
        const auto n = static_cast<std::int32_t>(batch.size());
        const hm_executor& executor = *threads_.executor();
        if (executor.run != nullptr) {
            executor.run(executor.user, n, compute_one, &context);
        } else {
            for (std::int32_t k = 0; k < n; ++k) compute_one(&context, k);
        }
        for (const MorphedDesign& result : batch)
            if (result.fault) std::rethrow_exception(result.fault);
    }

    void take(SampleShard& shard, MorphedDesign& result, std::int64_t number) {
        for (const std::string& warning : result.design.warnings) warn(warning);
        if (result.refusal.empty()) reject_by_section(result);
        if (result.refusal.empty() && result.needs_safe) {
            if (arguments_.has("--linear"))
                result.refusal = "one linear step does not leave a good mesh";
            else morpher_.morph_safely(result);
        }
        if (result.measures.empty()) result.measures.resize(measures_.names().size(), unknown);
        SampleRow row;
        row.design = number;
        row.numbers = table_.numbers_of(result);
        if (result.refusal.empty()) result.refusal = limits_.refusal(row.numbers);
        row.reason = result.refusal;
        row.way = result.way;
        if (space_.has_files()) row.section = space_.file(number);
        if (row.is_accepted()) row.split = splits_.split(number, row.numbers);
        if (row.is_accepted()) files_.write(folder_, result, number);
        shard.add(row, result);
    }

    // Limits on the section reject a design before a safe morph is spent on it.
    void reject_by_section(MorphedDesign& result) const {
        if (!result.needs_safe) return;
        MorphedDesign optimist;
        optimist.design = result.design;
        optimist.measures = result.measures;
        std::vector<double> numbers = table_.numbers_of(optimist);
        result.refusal = limits_.refusal_from(numbers, table_.first_measure());
    }

    void draw(std::int64_t next) {
        const double share = double(next - begin_) / double(space_.count() - begin_);
        const double left = watch_.seconds() * (1 - share) / share;
        const std::string text = left < 100 ? std::to_string(int(left + 1)) + " s left"
                                            : std::to_string(int(left / 60 + 1)) + " min left";
        bar_.draw(text.c_str(), double(next) / double(space_.count()));
    }

    void finish() {
        OutputFiles files;
        SampleSummary summary;
        std::ostream& csv = files.add(folder_.file("designs.csv"));
        std::ostream* const series =
            files_.has_vtk() ? &files.add(folder_.file("vtk/series.pvd")) : nullptr;
        if (series != nullptr)
            *series << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n"
                       "<Collection>\n";
        table_.write_names(csv);
        table_.read(folder_, shards_, [&](const SampleRow& row) {
            summary.add(row);
            table_.write(csv, row);
            if (series == nullptr || !row.is_accepted()) return;
            const std::string path = folder_.vtk_of(row.design);
            *series << "<DataSet timestep=\"" << row.design + 1 << "\" file=\""
                    << path.substr(path.find_last_of('/') + 1) << "\"/>\n";
        });
        if (series != nullptr) *series << "</Collection>\n</VTKFile>\n";
        write_sample_index(files.add(folder_.file("index.html")), basis_, space_, table_, summary);
        write_sample_description(
            files.add(folder_.file("README.md")),
            {arguments_.operand(0), arguments_.operand(1), settings_, splits_.description(),
             SampleShard::description(table_, mesh_, walls_.get())},
            space_, table_, summary);
        bar_.wipe();
        files.commit();
        const SampleRun run = {shards_, begin_, space_.count() - begin_, watch_.seconds()};
        if (arguments_.has("--json")) print_json(summary, run);
        else print_summary(summary, run);
    }

    const Arguments& arguments_;
    SampleFolder folder_;
    std::string settings_;
    Mesh mesh_;
    Basis basis_;
    DesignSpace space_;
    SectionMeasures measures_;
    SampleTable table_;
    Limits limits_;
    SampleSplits splits_;
    Threads threads_;
    DesignMorpher morpher_;
    std::vector<MorphedDesign> batch_;  // the designs that are being made
    std::int64_t per_shard_, shards_ = 0, begin_ = 0;
    DesignFiles files_;
    std::unique_ptr<WallChains> walls_;
    std::unique_ptr<WallDistances> distances_;
    ProgressBar bar_;
    Stopwatch watch_;
};

}  // namespace

void run_sample(const Arguments& arguments) { Sampling(arguments).run(); }

}  // namespace cli
