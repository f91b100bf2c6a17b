"""Declarations for cffi, read from the installed headers.

The headers of harmorph are the only definition of the interface. ``declarations(folder)`` returns
the text that ``cffi.FFI.cdef`` takes: the headers without comments, preprocessor lines and the
words that cffi does not know. A header that this module does not understand is refused by cffi when
the extension is built, and the C++ compiler compares all structs and constants with the headers.
"""

import re
from pathlib import Path

TOPICS = (
    "harmorph",
    "harmorph_design",
    "harmorph_space",
    "harmorph_parts",
    "harmorph_study",
    "harmorph_fields",
    "harmorph_quality",
)

# The pool of threads of harmorph_pthreads.h consists of inline functions, which cffi cannot read.
# The compiler checks these three lines against the header.
THREADS = """
typedef struct { ...; } hm_pthreads;
hm_executor hm_pthreads_start(hm_pthreads* pool, int32_t n_threads);
void hm_pthreads_stop(hm_pthreads* pool);
"""


def version(folder):
    """Return HM_VERSION of the headers in `folder`."""
    text = (Path(folder) / "harmorph.h").read_text(encoding="utf-8")
    return re.search(r'#define HM_VERSION "([^"]*)"', text).group(1)


def declarations(folder):
    """Return the declarations of the headers in `folder` as text for ``cffi.FFI.cdef``."""
    return "".join(_declared(Path(folder) / f"{name}.h") for name in TOPICS) + THREADS


def _declared(header):
    text = header.read_text(encoding="utf-8")
    text = re.sub(r"/\*.*?\*/", " ", text, flags=re.S)
    abi = "\n".join(re.findall(r"^#define HM_ABI \d+", text, flags=re.M))
    # The braces of extern "C" stand inside preprocessor lines.
    text = re.sub(r'^#ifdef __cplusplus\n.*?^#endif', "", text, flags=re.S | re.M)
    text = re.sub(r"^#.*?(?<!\\)$", "", text, flags=re.S | re.M)
    text = text.replace("HM_API ", "").replace("INT32_MIN", "-0x80000000")
    return f"{abi}\n{text}\n"
