# usage: names.py meshes MESH FOLDER       writes meshes whose markers have names of all bytes, beside their names
#        names.py picture NAMES FILE       an SVG file: XML, which shows each of the names
#        names.py page NAMES FILE          a page: UTF-8, whose data are JSON and have each of the names
#        names.py text NAMES FILE          output for a terminal: UTF-8 without control characters
#        names.py json NAMES FILE          one JSON object, which has each of the names
# Names are shown as UTF-8; a byte that belongs to no printable character is shown as \x1B.
import html.parser
import json
import pathlib
import sys
import xml.etree.ElementTree


def shown(name):
    text = ""
    while name:
        for length in range(1, 5):
            try:
                character = name[:length].decode("utf-8")
            except UnicodeDecodeError:
                continue
            if len(character) != 1:
                continue
            code = ord(character)
            if code < 32 or 127 <= code < 160 or code in (0xFFFE, 0xFFFF):
                continue
            text, name = text + character, name[length:]
            break
        else:
            text, name = text + "\\x%02X" % name[0], name[1:]
    return text


def hostile_names():
    separators = b"\0\n\r%,@=*?"  # of SU2 files, and of options that take markers
    names = [b"a%cz" % byte for byte in range(256) if byte not in separators]
    names += [b"</text></svg>", b"]]>&amp;<!--", b"</script><script>", b'"\'\\', "β→😀".encode(), b"\x1b[31mred\x1b[0m"]
    names += [b"\xc0\xafx", b"\xed\xa0\x80x", b"\xef\xbf\xbfx", b"\xf4\x90\x80\x80x", b"\xc2\x9bx", b"\xf0\x9f\x98",
              b"\xe2\x82x", b"x\xff\xfe\xfd"]
    return names


def write_meshes(mesh, folder):
    head, body = pathlib.Path(mesh).read_bytes().split(b"MARKER_TAG= far\n")
    head = head.replace(b"NMARK= 2", b"NMARK= 49")
    faces = body.splitlines()[1:49]
    names = hostile_names()
    names += [b"more%d" % k for k in range(-len(names) % 48)]
    for number, first in enumerate(range(0, len(names), 48)):
        some = names[first:first + 48]
        text = head
        for name, face in zip(some, faces):
            text += b"MARKER_TAG= " + name + b"\nMARKER_ELEMS= 1\n" + face + b"\n"
        (folder / ("mesh%d.su2" % number)).write_bytes(text)
        (folder / ("mesh%d.names" % number)).write_bytes(b"\n".join(some))
        print(number)


class Scripts(html.parser.HTMLParser):
    def __init__(self):
        super().__init__()
        self.inside, self.data = False, []

    def handle_starttag(self, tag, attributes):
        self.inside = tag == "script"

    def handle_endtag(self, tag):
        self.inside = False

    def handle_data(self, data):
        if self.inside:
            self.data.append(data)


def texts_of(data):
    if isinstance(data, dict):
        data = list(data.values())
    if isinstance(data, list):
        return [text for item in data for text in texts_of(item)]
    return [data] if isinstance(data, str) else []


what, names, path = sys.argv[1:]
if what == "meshes":
    write_meshes(names, pathlib.Path(path))
    sys.exit()
wanted = [shown(name) for name in pathlib.Path(names).read_bytes().split(b"\n")]
found = pathlib.Path(path).read_bytes().decode("utf-8")
if what == "picture":
    found = [element.text for element in xml.etree.ElementTree.fromstring(found).iter() if element.text]
elif what == "page":
    parser = Scripts()
    parser.feed(found)
    text = "".join(parser.data)
    found = texts_of(json.JSONDecoder().raw_decode(text[text.index("page_data = ") + len("page_data = "):])[0])
elif what == "json":
    # JSON keeps the characters below a blank: they are no bytes for a terminal.
    found = [shown(text.encode()) for text in texts_of(json.loads(found))]
elif what == "text":
    if any(ord(c) < 32 and c != "\n" or 127 <= ord(c) < 160 for c in found):
        sys.exit("a control character reaches the terminal")
    wanted = []
if what == "page":
    found = [shown(text.encode()) for text in found if len(text) < 100]  # no arrays of numbers
missing = [name for name in wanted if name not in found]
if missing:
    sys.exit("missing: " + ascii(missing))
