"use strict";
// moves.txt, out of the page and into it, and what is said of it.

class Files {
    constructor(app) {
        this.app = app;
    }

    save() {
        const link = document.createElement("a");
        link.href = URL.createObjectURL(new Blob([this.app.shape.text()], { type: "text/plain" }));
        link.download = "moves.txt";
        link.click();
        setTimeout(() => URL.revokeObjectURL(link.href), 10000);
        this.say(
            this.app.is_valid()
                ? "Saved as moves.txt, for harmorph morph --move"
                : "Saved as moves.txt; harmorph morph will want --safe or --force",
        );
    }

    open(file) {
        file.text().then((text) => this.load(text, file.name));
    }

    load(text, name = "moves.txt") {
        try {
            this.app.after(() => this.app.shape.load(text));
        } catch (error) {
            this.say(`${name}: ${error.message}`);
        }
    }

    say(text) {
        const message = element("message");
        message.textContent = text;
        message.hidden = false;
        clearTimeout(this.saying);
        this.saying = setTimeout(() => {
            message.hidden = true;
        }, 4000);
    }
}
