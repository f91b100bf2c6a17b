"use strict";
// The legend explains the present colours: their scale, and the distribution of the values.

class Legend {
    constructor(app) {
        this.app = app;
    }

    // Returns a round angle, so that the scale does not change with every movement.
    most_degrees() {
        const most = this.app.wall.angle.reduce((a, b) => Math.max(a, b), 0);
        return [1, 2, 5, 10, 20, 45, 90, 180].find((degrees) => most <= degrees) || 180;
    }

    wall_colour(i) {
        const scale = scales[this.app.options.theme];
        if (this.app.options.colour === "angle")
            return scale.good.css(1 - this.app.wall.angle[i] / this.most_degrees());
        return scale.change.css(Legend.place_of_ratio(this.app.wall.height[i]));
    }

    // Returns the content of the histogram for the present colours.
    distribution() {
        const { cells, wall, options, picture, data } = this.app,
            scale = scales[options.theme];
        const mean = (values) => values.reduce((sum, value) => sum + value, 0) / Math.max(values.length, 1);
        const count = (values, holds) => values.reduce((sum, value) => (holds(value) ? sum + 1 : sum), 0);
        const least = (values) => values.reduce((a, b) => Math.min(a, b), Infinity);
        const most = (values) => values.reduce((a, b) => Math.max(a, b), -Infinity);
        switch (options.colour) {
            case "quality":
                return {
                    values: cells.quality,
                    low: 0,
                    high: 1,
                    low_text: "0 poor",
                    high_text: "good 1",
                    name: "size-skew quality",
                    colour_at: (value) => scale.good.css(value),
                    summary: `${count(cells.quality, (value) => value < 0.5)} of ${cells.n} cells below 0.5`,
                };
            case "angle": {
                const high = this.most_degrees();
                return {
                    values: wall.angle,
                    low: 0,
                    high,
                    low_text: "0°",
                    high_text: `${high}°`,
                    name: "change of the angle at the wall",
                    colour_at: (value) => scale.good.css(1 - value / high),
                    summary: `${brief(most(wall.angle))}° at most, ${brief(mean(wall.angle))}° on average`,
                };
            }
            case "height":
                return {
                    values: wall.height.map(Legend.place_of_ratio),
                    low: 0,
                    high: 1,
                    low_text: "½",
                    high_text: "2",
                    name: "first-layer height, after over before",
                    colour_at: (value) => scale.change.css(value),
                    summary:
                        `${brief(least(wall.height))} to ${brief(most(wall.height))}, ` +
                        `${brief(mean(wall.height))} on average`,
                };
            default: {
                const [low, high] = picture.value_range,
                    i = this.app.selection.shown_function();
                return {
                    values: picture.values,
                    low,
                    high,
                    low_text: brief(low),
                    high_text: brief(high),
                    name: i < data.n_control ? `function of control point ${i + 1}` : "function of the body",
                    colour_at: (value) => scale.function.css((value - low) / (high - low || 1)),
                    summary: `lines every ${brief(picture.level_distance)}`,
                };
            }
        }
    }
}
Legend.place_of_ratio = (ratio) => 0.5 + 0.5 * Math.log2(Math.max(ratio, 1e-9)); // from 1/2 to 2, with 1 in the middle
