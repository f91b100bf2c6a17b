"use strict";
// Files that the page writes and reads, and the messages about them.

class Files {
    constructor(app) {
        this.app = app;
    }

    save() {
        const { shape, panel } = this.app;
        if (this.app.displaced) {
            this.say(
                "Not saved: displacements of wall points are no movement of control points; harmorph displace --wall " +
                    "makes this mesh from their file",
            );
            return;
        }
        this.write("moves.txt", [shape.text() + panel.design.states.text()], "text/plain");
        this.say(
            this.app.is_valid() && this.app.reached === ""
                ? "Saved as moves.txt for harmorph morph --move"
                : this.app.wall.crossing.length > 0
                  ? "Saved as moves.txt; no mesh can have this wall, which crosses itself"
                  : "Saved as moves.txt; harmorph morph needs --safe for this movement",
        );
    }

    // Saves the wall of the section that the table describes, as an airfoil file in Selig's order.
    save_section() {
        const section = this.app.selection.section();
        this.write(`${section.name}.dat`, [section.text()], "text/plain");
        this.say(`Saved as ${section.name}.dat for harmorph fit and morph --to-airfoil`);
    }

    // Saves the mesh with the overlay.
    save_picture() {
        const { canvas } = this.app.picture.painter,
            picture = document.createElement("canvas");
        Object.assign(picture, { width: canvas.width, height: canvas.height });
        this.app.draw(); // WebGL keeps a picture during one task only
        for (const layer of [canvas, element("handles")]) picture.getContext("2d").drawImage(layer, 0, 0);
        picture.toBlob((bytes) => this.write("mesh.png", [bytes], "image/png"));
        this.say("Saved as mesh.png");
    }

    write(name, parts, type) {
        const link = document.createElement("a");
        link.href = URL.createObjectURL(new Blob(parts, { type }));
        link.download = name;
        link.click();
        setTimeout(() => URL.revokeObjectURL(link.href), 10000);
    }

    // Opens a file of any kind that the page knows: an airfoil has two numbers in a line, moves and displacements of
    // wall points have three; the latter name a point that is no control point.
    open(file) {
        file.text().then((text) => this.take(text, file.name));
    }
    take(text, name) {
        const { farther, data } = this.app,
            rows = /^\s*(rigid|# state|# control)/m.test(text) ? [] : rows_of_numbers(text);
        if (rows.length > 3 && rows[0].length === 2)
            farther.begin("Fitting the airfoil …", () => farther.airfoil(text, name));
        else if (rows.some(([point]) => !(point >= 1 && point <= data.n_control)) && rows[0].length === 3)
            farther.begin("Displacing wall points …", () => farther.displace(text, name));
        else this.load(text, name);
    }

    load(text, name = "moves.txt") {
        try {
            const { states } = this.app.panel.design,
                found = states.read(text);
            this.app.after(() => this.app.shape.load(text));
            states.add(found);
        } catch (error) {
            this.say(`${name}: ${error.message}`);
        }
    }

    say(text) {
        const message = element("message");
        message.textContent = text;
        message.hidden = text === "";
        clearTimeout(this.saying);
        this.saying = setTimeout(() => {
            message.hidden = true;
        }, 4000);
    }
}
