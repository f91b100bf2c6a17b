"use strict";
// Lines and triangles of the mesh, given in pixels: by WebGL 2, or on a canvas where the browser has no graphics
// processor for it, which is then the faster way.

class GlPainter {
    constructor(canvas, more = { failIfMajorPerformanceCaveat: true }) {
        const gl = (this.gl = canvas.getContext("webgl2", { antialias: true, alpha: false, ...more }));
        if (!gl || (more.failIfMajorPerformanceCaveat && GlPainter.is_software(gl))) throw new Error("no WebGL 2");
        this.canvas = canvas;
        const vertex = `#version 300 es
            in vec2 at; in vec4 its; uniform vec2 size; uniform vec4 colour; out vec4 shade;
            void main() {
                gl_Position = vec4(2.0 * at.x / size.x - 1.0, 1.0 - 2.0 * at.y / size.y, 0.0, 1.0);
                shade = colour.a > 0.0 ? colour : its;
            }`;
        const fragment = `#version 300 es
            precision mediump float; in vec4 shade; out vec4 to;
            void main() { to = vec4(shade.rgb * shade.a, shade.a); }`;
        const program = gl.createProgram();
        for (const [kind, text] of [
            [gl.VERTEX_SHADER, vertex],
            [gl.FRAGMENT_SHADER, fragment],
        ]) {
            const shader = gl.createShader(kind);
            gl.shaderSource(shader, text);
            gl.compileShader(shader);
            gl.attachShader(program, shader);
        }
        gl.bindAttribLocation(program, 0, "at");
        gl.bindAttribLocation(program, 1, "its");
        gl.linkProgram(program);
        if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
        gl.useProgram(program);
        this.size = gl.getUniformLocation(program, "size");
        this.colour = gl.getUniformLocation(program, "colour");
        this.positions = gl.createBuffer();
        this.colours = gl.createBuffer();
        this.indices = new Map();
        gl.enableVertexAttribArray(0);
        gl.enable(gl.BLEND);
        gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    }

    static is_software(gl) {
        const names = gl.getExtension("WEBGL_debug_renderer_info");
        return (
            names !== null &&
            /swiftshader|llvmpipe|softpipe|software/i.test(gl.getParameter(names.UNMASKED_RENDERER_WEBGL))
        );
    }

    begin(width, height, ratio, background) {
        const { gl, canvas } = this,
            across = Math.round(width * ratio),
            up = Math.round(height * ratio);
        if (canvas.width !== across) canvas.width = across;
        if (canvas.height !== up) canvas.height = up;
        gl.viewport(0, 0, across, up);
        gl.uniform2f(this.size, width, height);
        gl.clearColor(background[0], background[1], background[2], 1);
        gl.clear(gl.COLOR_BUFFER_BIT);
    }

    put(positions) {
        const { gl } = this;
        gl.bindBuffer(gl.ARRAY_BUFFER, this.positions);
        gl.bufferData(gl.ARRAY_BUFFER, positions, gl.STREAM_DRAW);
        gl.vertexAttribPointer(0, 2, gl.FLOAT, false, 0, 0);
    }

    // Pairs of points; the same array of pairs is sent once.
    lines(positions, pairs, colour) {
        const { gl } = this;
        if (pairs.length === 0) return;
        this.put(positions);
        gl.disableVertexAttribArray(1);
        gl.uniform4f(this.colour, ...colour);
        if (!this.indices.has(pairs)) {
            const buffer = gl.createBuffer();
            gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, buffer);
            gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, pairs, gl.STATIC_DRAW);
            this.indices.set(pairs, buffer);
        }
        gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.indices.get(pairs));
        gl.drawElements(gl.LINES, pairs.length, gl.UNSIGNED_INT, 0);
    }

    segments(positions, n, colour) {
        const { gl } = this;
        this.put(positions.subarray(0, 4 * n));
        gl.disableVertexAttribArray(1);
        gl.uniform4f(this.colour, ...colour);
        gl.drawArrays(gl.LINES, 0, 2 * n);
    }

    // n triangles: three pixels and three colours each.
    triangles(positions, colours, n) {
        const { gl } = this;
        if (n === 0) return;
        this.put(positions.subarray(0, 6 * n));
        gl.bindBuffer(gl.ARRAY_BUFFER, this.colours);
        gl.bufferData(gl.ARRAY_BUFFER, colours.subarray(0, 12 * n), gl.STREAM_DRAW);
        gl.enableVertexAttribArray(1);
        gl.vertexAttribPointer(1, 4, gl.UNSIGNED_BYTE, true, 0, 0);
        gl.uniform4f(this.colour, 0, 0, 0, 0);
        gl.drawArrays(gl.TRIANGLES, 0, 3 * n);
    }

    // Waits until all is drawn.
    finish() {
        this.gl.readPixels(0, 0, 1, 1, this.gl.RGBA, this.gl.UNSIGNED_BYTE, new Uint8Array(4));
    }
}

class CanvasPainter {
    constructor(canvas) {
        this.canvas = canvas;
        this.context = canvas.getContext("2d");
    }

    static style(colour) {
        return `rgba(${colour
            .slice(0, 3)
            .map((part) => Math.round(255 * part))
            .join()},${colour[3]})`;
    }

    begin(width, height, ratio, background) {
        this.canvas.width = Math.round(width * ratio);
        this.canvas.height = Math.round(height * ratio);
        Object.assign(this, { width, height });
        this.context.setTransform(ratio, 0, 0, ratio, 0, 0);
        this.context.fillStyle = CanvasPainter.style([...background, 1]);
        this.context.fillRect(0, 0, width, height);
        this.context.lineWidth = 1 / ratio;
    }

    line(ax, ay, bx, by) {
        if (
            (ax < 0 && bx < 0) ||
            (ay < 0 && by < 0) ||
            (ax > this.width && bx > this.width) ||
            (ay > this.height && by > this.height)
        )
            return;
        this.context.moveTo(ax, ay);
        this.context.lineTo(bx, by);
    }

    lines(positions, pairs, colour) {
        const { context } = this;
        context.beginPath();
        for (let i = 0; i < pairs.length; i += 2) {
            const a = 2 * pairs[i],
                b = 2 * pairs[i + 1];
            this.line(positions[a], positions[a + 1], positions[b], positions[b + 1]);
        }
        context.strokeStyle = CanvasPainter.style(colour);
        context.stroke();
    }

    segments(positions, n, colour) {
        const { context } = this;
        context.beginPath();
        for (let i = 0; i < 4 * n; i += 4)
            this.line(positions[i], positions[i + 1], positions[i + 2], positions[i + 3]);
        context.strokeStyle = CanvasPainter.style(colour);
        context.stroke();
    }

    // One colour for each triangle: the mean of its corners'.
    triangles(positions, colours, n) {
        const { context } = this;
        for (let i = 0; i < n; ++i) {
            const p = 6 * i,
                c = 12 * i;
            context.beginPath();
            context.moveTo(positions[p], positions[p + 1]);
            context.lineTo(positions[p + 2], positions[p + 3]);
            context.lineTo(positions[p + 4], positions[p + 5]);
            const [red, green, blue] = [c, c + 1, c + 2].map(
                (part) => (colours[part] + colours[part + 4] + colours[part + 8]) / 3,
            );
            context.fillStyle = `rgb(${red},${green},${blue})`;
            context.fill();
        }
    }

    finish() {
        this.context.getImageData(0, 0, 1, 1);
    }
}

function make_painter(canvas) {
    try {
        return new GlPainter(canvas);
    } catch (error) {
        if (canvas.getContext("2d")) return new CanvasPainter(canvas);
        const another = canvas.cloneNode(); // one that WebGL has had draws in no other way
        canvas.replaceWith(another);
        return new CanvasPainter(another);
    }
}
