# Of the paths of an SVG picture whose pieces are "Mx y l dx dy dx dy ... z": prints how many pieces run one way round and
# how many the other, where they enclose more than a tenth of a pixel.
{
    while (match($0, /M[^Mz]*z/)) {
        piece = substr($0, RSTART + 1, RLENGTH - 2)
        $0 = substr($0, RSTART + RLENGTH)
        sub(/^[^l]*l/, "", piece)   # places are relative to the first corner
        gsub(/-/, " -", piece)
        n = split(piece, d, /[ ,]+/)
        x = y = area = 0
        for (k = d[1] == "" ? 2 : 1; k < n; k += 2) {
            area += x * d[k + 1] - y * d[k]
            x += d[k]
            y += d[k + 1]
        }
        if (area > .2) ++left
        if (area < -.2) ++right
    }
}
END { print left + 0, right + 0 }
