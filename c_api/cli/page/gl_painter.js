"use strict";
// This painter draws by WebGL 2 what CanvasPainter draws on a 2D canvas. Cells and edges are sent once; a frame sends
// the places of the points and one number for each piece of a cell. All are textures, in which a vertex finds its place
// by its number.

const gl_common = `#version 300 es
    precision highp float; precision highp int; precision highp usampler2D;
    uniform vec2 size; uniform sampler2D at;
    ivec2 place(int k) { return ivec2(k & 2047, k >> 11); }
    vec4 on_canvas(vec2 p) { return vec4(2.0 * p.x / size.x - 1.0, 1.0 - 2.0 * p.y / size.y, 0.0, 1.0); }
    vec4 pixel(uint point) { return on_canvas(texelFetch(at, place(int(point)), 0).xy); }
    const vec4 nowhere = vec4(2.0, 2.0, 2.0, 1.0);`;

// Each piece has six vertices. shown is 0 for good cells, 1 for bad cells, 2 for values of points.
const gl_cells = `${gl_common}
    uniform usampler2D pieces; uniform sampler2D values; uniform sampler2D scale; uniform int shown; uniform vec4 bad;
    out vec4 shade;
    void main() {
        int piece = gl_VertexID / 6, corner = gl_VertexID - 6 * piece;
        corner = corner < 3 ? corner : corner == 3 ? 0 : corner - 2;
        uint point = texelFetch(pieces, place(piece), 0)[corner];
        float value = texelFetch(values, place(shown == 2 ? int(point) : piece), 0).x;
        bool here = shown == 2 || (shown == 1 ? value < 0.0 : value >= 0.0 && value <= 1.0);
        shade = shown == 1 ? bad : texelFetch(scale, ivec2(int(255.0 * clamp(value, 0.0, 1.0) + 0.5), 0), 0);
        gl_Position = here ? pixel(point) : nowhere;
    }`;
// Each edge has two vertices.
const gl_lines = `${gl_common}
    uniform usampler2D edges; uniform sampler2D spacing; uniform vec4 colour; uniform float fade;
    out vec4 shade;
    void main() {
        int edge = gl_VertexID / 2;
        float pixels = fade * texelFetch(spacing, place(edge), 0).x;
        float strength = fade > 0.0 ? clamp((pixels - 1.0) / 6.0, 0.0, 1.0) : 1.0;
        shade = vec4(colour.rgb, strength * colour.a);
        gl_Position = strength > 0.0 ? pixel(texelFetch(edges, place(edge), 0)[gl_VertexID - 2 * edge]) : nowhere;
    }`;
const gl_segments = `${gl_common}
    in vec2 given; uniform vec4 colour; out vec4 shade;
    void main() { gl_Position = on_canvas(given); shade = colour; }`;

class GlPainter {
    // Throws an error where the browser has no WebGL 2, or has it without a graphics processor, which takes longer than
    // a 2D canvas.
    constructor(canvas, pieces, more = { failIfMajorPerformanceCaveat: true }) {
        const gl = (this.gl = canvas.getContext("webgl2", { antialias: true, alpha: false, ...more }));
        if (!gl || (more.failIfMajorPerformanceCaveat && GlPainter.is_software(gl))) throw new Error("no WebGL 2");
        this.canvas = canvas;
        this.n_pieces = pieces.length / 4;
        this.programs = [gl_cells, gl_lines, gl_segments].map((text) => this.program(text));
        this.positions = gl.createBuffer();
        this.textures = new Map(); // by their names
        const { RGBA32UI, RGBA_INTEGER, RG32UI, RG_INTEGER, UNSIGNED_INT, FLOAT } = gl;
        this.formats = {
            four: [RGBA32UI, RGBA_INTEGER, UNSIGNED_INT, 4],
            two: [RG32UI, RG_INTEGER, UNSIGNED_INT, 2],
            places: [gl.RG32F, gl.RG, FLOAT, 2],
            number: [gl.R32F, gl.RED, FLOAT, 1],
            bytes: [gl.RGBA8, gl.RGBA, gl.UNSIGNED_BYTE, 4],
        };
        this.pieces = new Uint32Array(pieces);
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

    program(vertex) {
        const { gl } = this,
            program = gl.createProgram();
        const fragment = `#version 300 es
            precision mediump float; in vec4 shade; out vec4 to;
            void main() { to = vec4(shade.rgb * shade.a, shade.a); }`;
        for (const [kind, text] of [
            [gl.VERTEX_SHADER, vertex],
            [gl.FRAGMENT_SHADER, fragment],
        ]) {
            const shader = gl.createShader(kind);
            gl.shaderSource(shader, text);
            gl.compileShader(shader);
            gl.attachShader(program, shader);
        }
        gl.bindAttribLocation(program, 0, "given");
        gl.linkProgram(program);
        if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
        return program;
    }

    begin(width, height, ratio, background) {
        const { gl, canvas } = this,
            across = Math.round(width * ratio),
            up = Math.round(height * ratio);
        if (canvas.width !== across) canvas.width = across;
        if (canvas.height !== up) canvas.height = up;
        Object.assign(this, { width, height });
        gl.viewport(0, 0, across, up);
        gl.clearColor(background[0], background[1], background[2], 1);
        gl.clear(gl.COLOR_BUFFER_BIT);
    }

    // Binds the texture of an array, in rows of 2048 texels; the array is sent again if its numbers have changed.
    texture(unit, name, numbers, format, has_changed) {
        const { gl } = this,
            [internal, external, type, per_texel] = this.formats[format],
            rows = Math.ceil(numbers.length / per_texel / 2048);
        gl.activeTexture(gl.TEXTURE0 + unit);
        let texture = this.textures.get(name);
        if (texture && texture.rows === rows) {
            gl.bindTexture(gl.TEXTURE_2D, texture.handle);
            if (!has_changed) return;
        } else {
            texture = { handle: gl.createTexture(), rows, padded: new numbers.constructor(rows * 2048 * per_texel) };
            this.textures.set(name, texture);
            gl.bindTexture(gl.TEXTURE_2D, texture.handle);
            for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER])
                gl.texParameteri(gl.TEXTURE_2D, filter, gl.NEAREST);
            gl.texStorage2D(gl.TEXTURE_2D, 1, internal, 2048, rows);
        }
        texture.padded.set(numbers);
        gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, 2048, rows, external, type, texture.padded);
    }

    // Begins to draw with a program; textures are names in the order of their units.
    use(program, textures, colour) {
        const { gl } = this,
            uniform = (name) => gl.getUniformLocation(program, name);
        gl.useProgram(program);
        gl.uniform2f(uniform("size"), this.width, this.height);
        textures.forEach((name, unit) => gl.uniform1i(uniform(name), unit));
        if (colour) gl.uniform4f(uniform("colour"), ...colour);
        return uniform;
    }

    place(screen) {
        this.texture(0, "at", screen, "places", true);
    }

    fill_cells(values, scale, bad) {
        this.fill(values, scale, [...bad, 1], values.includes(cell_value.bad) ? [0, 1] : [0]);
    }

    fill_points(values, scale) {
        this.fill(values, scale, [0, 0, 0, 1], [2]);
    }

    fill(values, scale, bad, passes) {
        const { gl } = this,
            uniform = this.use(this.programs[0], ["at", "pieces", "values", "scale"]);
        this.texture(1, "pieces", this.pieces, "four", false);
        this.texture(2, passes[0] === 2 ? "of points" : "of pieces", values, "number", true);
        this.texture(3, "scale", new Uint8Array(scale.pixels().buffer), "bytes", true);
        gl.uniform4f(uniform("bad"), ...bad);
        for (const pass of passes) {
            gl.uniform1i(uniform("shown"), pass);
            gl.drawArrays(gl.TRIANGLES, 0, 6 * this.n_pieces);
        }
    }

    lines({ pairs, spacing }, colour, scale, fade) {
        const { gl } = this;
        if (spacing.length === 0) return;
        const uniform = this.use(this.programs[1], ["at", "edges", "spacing"], colour);
        this.texture(1, pairs, pairs, "two", false);
        this.texture(2, spacing, spacing, "number", false);
        gl.uniform1f(uniform("fade"), fade ? scale : 0);
        gl.drawArrays(gl.LINES, 0, 2 * spacing.length);
    }

    segments(positions, n, colour) {
        const { gl } = this;
        this.use(this.programs[2], [], colour);
        gl.bindBuffer(gl.ARRAY_BUFFER, this.positions);
        gl.bufferData(gl.ARRAY_BUFFER, positions.subarray(0, 4 * n), gl.STREAM_DRAW);
        gl.enableVertexAttribArray(0);
        gl.vertexAttribPointer(0, 2, gl.FLOAT, false, 0, 0);
        gl.drawArrays(gl.LINES, 0, 2 * n);
        gl.disableVertexAttribArray(0);
    }

    // Ends a picture: nothing is left to do.
    end() {}

    finish() {
        this.gl.readPixels(0, 0, 1, 1, this.gl.RGBA, this.gl.UNSIGNED_BYTE, new Uint8Array(4));
    }
}

function make_painter(canvas, pieces) {
    try {
        return new GlPainter(canvas, pieces);
    } catch (error) {
        const another = canvas.cloneNode(); // a canvas that WebGL has had draws in no other way
        canvas.replaceWith(another);
        return new CanvasPainter(another, pieces);
    }
}
