"use strict";
// From a mesh to a basis: check, the choice of walls, fit, solve.

class Prepare {
    constructor(bench) {
        this.bench = bench;
        element("fit").onclick = () => bench.attempt("fit", () => this.fit());
        element("solve").onclick = () => bench.attempt("solve", () => this.solve());
        for (const id of ["n_points", "closed", "more_fit"]) element(id).onchange = () => this.forget_curves();
        for (const id of ["operator", "more_solve"]) element(id).onchange = () => this.forget_basis();
    }

    async open(given) {
        const { bench } = this,
            files = await unpacked_files(given);
        bench.begin_mesh(new Map(files), mesh_among(files));
        const picture = free_path(bench.files, "mesh.svg");
        let result;
        try {
            const words = ["check", operand(bench.mesh), "--json", "--svg", picture];
            result = await bench.program.run("Reading the mesh", words, bench.files);
        } catch (error) {
            // A mesh with inverted cells is shown all the same.
            if (!bench.files.has(picture)) {
                if (error instanceof Cancelled) bench.close_mesh();
                throw error;
            }
            this.show_mesh(error.result, picture);
            throw error;
        }
        this.show_mesh(result, picture);
    }
    show_mesh(result, picture) {
        const { bench } = this,
            facts = JSON.parse(result.said);
        bench.view.show_picture(bench.files.get(picture), `The mesh with ${plural(facts.markers.length, "marker")}`);
        bench.view.show("view");
        show_facts(element("facts"), [
            ["Points", facts.points.toLocaleString("en")],
            ["Cells", facts.cells.toLocaleString("en")],
            ["Smallest quality", brief(facts.min_quality)],
            ["Inverted cells", String(facts.inverted)],
        ]);
        bench.boundary = new Boundary(facts, () => this.forget_curves());
        bench.boundary.show(element("pieces"));
        element("guess_note").hidden = bench.boundary.guessed.size === 0;
        for (const id of ["mesh_box", "boundary_box"]) element(id).hidden = false;
        this.forget_curves();
        bench.show_files();
        bench.update_panel();
        const warnings = warnings_of(result);
        if (warnings.length > 0) bench.view.say(warnings.join("\n"));
        const [points, markers] = [plural(facts.points, "point"), plural(facts.markers.length, "marker")];
        bench.view.speak(`The mesh has ${points} and ${markers}.`);
    }

    // What was fitted no longer belongs to what is chosen.
    forget_curves() {
        const { bench } = this,
            needs_fit = bench.boundary.groups("curve").length > 0;
        this.curves = [];
        show_lines(element("fit_result"), []);
        element("fit_box").hidden = !needs_fit;
        this.forget_basis();
    }
    forget_basis() {
        const { bench } = this,
            ready = this.curves.length === bench.boundary.groups("curve").length && bench.boundary.moves();
        bench.basis = null;
        show_lines(element("solve_result"), []);
        element("solve_box").hidden = !bench.boundary.moves();
        element("solve").disabled = !ready;
        element("solve").classList.toggle("main", ready);
        element("fit").classList.toggle("main", !ready);
        bench.update_tabs();
    }

    async fit() {
        const { bench } = this,
            curves = [],
            says = [];
        for (const group of bench.boundary.groups("curve")) {
            const name = group[0].name.replace(/[^\w.-]/g, "_").slice(0, 60) || "wall",
                path = free_path(new Map([...bench.inputs, ...curves.map((curve) => [curve])]), `${name}.curve`),
                words = ["fit", operand(bench.mesh), "--marker", Boundary.places(group)];
            words.push("--points", element("n_points").value);
            if (element("closed").value !== "auto") words.push("--closed", element("closed").value);
            words.push(...words_of(element("more_fit").value), "-o", path, "--json");
            const result = await bench.program.run("Fitting the curve", words, bench.files),
                report = JSON.parse(result.said);
            const points = plural(report.points, "control point"),
                error = `the mesh's points are within ${brief(report.max_error)} of the curve`;
            says.push(`${path}: ${points}, ${report.closed}; ${error}`, ...warnings_of(result));
            curves.push(path);
        }
        this.curves = curves;
        this.forget_basis();
        show_lines(element("fit_result"), says);
        const picture = free_path(bench.inputs, "curve.svg"),
            shown = curves.flatMap((path) => ["--curve", path]),
            words = ["check", operand(bench.mesh), ...shown, "--svg", picture];
        await bench.program.run("Drawing the curve", words, bench.files);
        bench.view.show_picture(bench.files.get(picture), "The mesh with its B-spline and control points");
        bench.view.show("view");
        bench.show_files();
        bench.view.speak(says.join(". "));
        element("solve").focus();
    }

    async solve() {
        const { bench } = this,
            basis = free_path(bench.inputs, "mesh.basis"),
            words = ["solve", operand(bench.mesh), ...bench.boundary.conditions(this.curves)];
        if (element("operator").value !== "conformal") words.push("--operator", element("operator").value);
        words.push(...words_of(element("more_solve").value), "--kernel", "baseline", "-o", basis, "--json");
        const result = await bench.program.run("Solving", words, bench.files),
            report = JSON.parse(result.said),
            seconds = report.setup_seconds + report.factor_seconds + report.solve_seconds;
        bench.basis = basis;
        show_lines(element("solve_result"), [
            `${plural(report.functions, "function")} in ${brief(seconds)} s; residual ${brief(report.residual)}`,
            ...warnings_of(result),
        ]);
        bench.show_files();
        bench.morph.forget();
        await bench.drag.open();
    }
}
