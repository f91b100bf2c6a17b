// What the tests of the workbench do with it, and how they count.

export class Checks {
    passed = 0;
    failed = 0;
    fail(text) {
        ++this.failed;
        console.log(`FAIL workbench: ${text}`);
    }
    holds(what, found, wanted) {
        if (JSON.stringify(found) === JSON.stringify(wanted)) ++this.passed;
        else this.fail(`${what}: ${JSON.stringify(found)}`);
    }
    near(what, found, wanted, allowed) {
        if (Math.abs(found - wanted) <= allowed) ++this.passed;
        else this.fail(`${what}: ${found}, not ${wanted}`);
    }
    finish() {
        console.log(`${this.passed} passed, ${this.failed} failed`);
        process.exitCode = this.failed === 0 ? 0 : 1;
    }
}

export const steps = (page) => {
    const idle = "element('work').hidden && bench.program.worker === null",
        // A frame that was on top a moment ago would still take clicks.
        settled = () => page.value("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))"),
        message = () => page.value("element('message').hidden ? '' : element('message').innerText");
    return {
        message,
        // A mesh is shown afterwards, or a message.
        async drop(files) {
            await page.value("bench.boundary = null; bench.view.say(''); 0");
            await page.drop(files);
            const shown = "(bench.boundary !== null && !element('view').hidden || !element('message').hidden)";
            await page.until(`${idle} && ${shown}`);
            await settled();
        },
        // Drops a file beside a mesh; it is taken as an airfoil, a table, or moves.
        async drop_beside(file, how) {
            await page.drop([file]);
            await page.until(`bench.morph.how === "${how}"`);
            await settled();
        },
        async fit() {
            await page.click("#fit");
            await page.until(`${idle} && (!element('solve').disabled || !element('message').hidden)`);
        },
        // Returns the session of the frame with the page, which has started.
        async solve() {
            await page.click("#solve");
            await page.until(`bench.tab === 'drag' && bench.drag.is_ready`);
            await settled();
            return page.frames.length > 0 ? page.frames[0] : page;
        },
        async open_tab(tab) {
            await page.click(`#tab_${tab}`);
            await page.until(`bench.tab === '${tab}'`);
            await settled();
        },
        async morph() {
            await page.value("bench.morph.result = null; element('result_box').hidden = true; 0");
            await settled();
            await page.click("#morph");
            await page.until(`${idle} && (!element('result_box').hidden || !element('message').hidden)`, 120);
            await settled();
        },
    };
};

// Runs in the page: returns the controls without a name, and those whose role needs a state that is missing.
export const labels = `() => {
    const name = (node) => (node.getAttribute("aria-label") ?? "") +
        [...(node.labels ?? [])].map((one) => one.textContent).join("") +
        (/^(BUTTON|SUMMARY)$/.test(node.tagName) ? node.textContent : "") + (node.alt ?? "") + (node.title ?? "");
    const wrong = [];
    const controls = "button, input, select, textarea, summary, iframe, [tabindex], [role]";
    for (const node of document.querySelectorAll(controls)) {
        if (node.closest("[hidden]") !== null || node.type === "file") continue;
        const has_role = /^(status|alert)$/.test(node.getAttribute("role"));
        if (!has_role && node.tagName !== "PRE" && name(node).trim() === "") wrong.push(node.id || node.outerHTML);
        if (node.getAttribute("role") === "radio" && !node.hasAttribute("aria-checked")) wrong.push(node.id);
    }
    const ids = [...document.querySelectorAll("[id]")].map(({ id }) => id);
    wrong.push(...ids.filter((id, place) => ids.indexOf(id) !== place).map((id) => "twice: " + id));
    for (const node of document.querySelectorAll("[aria-labelledby]"))
        if (document.getElementById(node.getAttribute("aria-labelledby")) === null) wrong.push(node.id);
    return wrong;
}`;
