#!/usr/bin/env python3
"""Checks that C++ sources include the standard headers of the names that they use.

Which other headers a standard header includes differs between releases of a standard library, so a source that relies on
it builds with one compiler and not with the next. For each std:: name, and each name of C that a C++ header declares, the source
or one of the project's headers that it includes must include a header that declares the name by the C++ standard. Includes of
third-party headers do not count. Names that nearly every header declares (std::move, std::size_t, std::pair) are not checked.

    Misc/check_includes.py [--root DIR]    checks the sources that git would track
    Misc/check_includes.py --self-test     tests the check itself on sources that break the rule
"""

import argparse
import functools
import itertools
import pathlib
import re
import subprocess
import sys
import tempfile

# Header: the names that it declares, of C++20 [headers]. A name may be in several.
DECLARES = {
    "algorithm": """clamp min max minmax sort stable_sort partial_sort nth_element find find_if find_if_not any_of all_of none_of
        count count_if copy copy_if copy_n fill fill_n transform for_each equal mismatch search replace replace_if remove remove_if
        remove_copy_if unique rotate reverse partition stable_partition lower_bound upper_bound equal_range binary_search merge
        includes max_element min_element minmax_element is_sorted push_heap pop_heap make_heap lexicographical_compare
        lexicographical_compare_three_way set_difference set_intersection set_union generate generate_n shuffle adjacent_find
        is_permutation swap_ranges iter_swap for_each_n move_backward copy_backward""",
    "any": "any any_cast",
    "array": "array to_array",
    "atomic": "atomic atomic_flag atomic_ref memory_order_relaxed memory_order_acquire memory_order_release",
    "bit": "bit_cast bit_ceil bit_floor bit_width countl_zero countr_zero popcount has_single_bit rotl rotr endian",
    "bitset": "bitset",
    "charconv": "from_chars to_chars chars_format from_chars_result to_chars_result",
    "chrono": "chrono",
    "cctype": "isalnum isalpha isdigit isspace isprint isupper islower isxdigit ispunct tolower toupper",
    "cerrno": "errno",
    "cfloat": "FLT_MAX FLT_MIN FLT_EPSILON DBL_MAX DBL_MIN DBL_EPSILON",
    "climits": "INT_MAX INT_MIN UINT_MAX CHAR_BIT LONG_MAX",
    "cmath": """abs acos acosh asin asinh atan atan2 atanh cbrt ceil copysign cos cosh erf erfc exp exp2 expm1 fabs fdim floor fma
        fmax fmin fmod frexp hypot ilogb isfinite isinf isnan ldexp lgamma llround log log10 log1p log2 lround modf nan nanf
        nearbyint nextafter pow remainder rint round signbit sin sinh sqrt tan tanh tgamma trunc""",
    "condition_variable": "condition_variable",
    "csignal": "signal sig_atomic_t raise SIGINT SIGTERM",
    "cstdint": """int8_t int16_t int32_t int64_t uint8_t uint16_t uint32_t uint64_t intptr_t uintptr_t intmax_t uintmax_t
        UINT64_MAX UINT32_MAX""",
    "cstdio": "fopen fclose fread fwrite fputs fputc puts printf fprintf snprintf sscanf fflush fseek ftell rename perror FILE",
    "cstdlib": """abort abs atoi atof atol calloc exit _Exit free getenv llabs malloc realloc strtod strtof strtol strtoll strtoul
        strtoull system div EXIT_SUCCESS EXIT_FAILURE""",
    "cstring": "memchr memcmp memcpy memmove memset strchr strcmp strcpy strerror strlen strncmp strrchr strstr",
    "ctime": "clock time localtime gmtime strftime time_t tm clock_t",
    "deque": "deque erase erase_if",
    "exception": "exception terminate current_exception rethrow_exception exception_ptr uncaught_exceptions",
    "filesystem": "filesystem",
    "forward_list": "forward_list",
    "fstream": "ifstream ofstream fstream",
    "functional": "function ref cref hash less greater plus multiplies bind invoke reference_wrapper equal_to identity not_fn",
    "future": "future async promise",
    "initializer_list": "initializer_list",
    "iomanip": "setw setprecision setfill quoted",
    "ios": "ios ios_base streamsize streamoff fixed hex",
    "iostream": "cout cerr cin clog",
    "istream": "istream ws",
    "iterator": """back_inserter inserter front_inserter distance next prev advance istreambuf_iterator ostreambuf_iterator
        make_move_iterator move_iterator reverse_iterator istream_iterator ostream_iterator""",
    "limits": "numeric_limits",
    "list": "list",
    "map": "map multimap erase_if",
    "memory": """unique_ptr shared_ptr weak_ptr make_unique make_shared enable_shared_from_this addressof destroy_at construct_at
        allocator default_delete align static_pointer_cast""",
    "memory_resource": "pmr",
    "mutex": "mutex lock_guard unique_lock scoped_lock once_flag call_once recursive_mutex",
    "new": "bad_alloc nothrow new_handler set_new_handler launder align_val_t",
    "numbers": "numbers",
    "numeric": "accumulate iota reduce inner_product partial_sum gcd lcm midpoint transform_reduce exclusive_scan inclusive_scan",
    "optional": "optional nullopt make_optional nullopt_t",
    "ostream": "ostream endl flush",
    "queue": "queue priority_queue",
    "random": """random_device mt19937 mt19937_64 uniform_int_distribution uniform_real_distribution normal_distribution
        minstd_rand""",
    "ratio": "ratio milli micro nano",
    "set": "set multiset erase_if",
    "shared_mutex": "shared_mutex shared_lock",
    "span": "span as_bytes dynamic_extent",
    "sstream": "stringstream istringstream ostringstream stringbuf",
    "stdexcept": "runtime_error logic_error invalid_argument out_of_range length_error domain_error range_error",
    "streambuf": "streambuf",
    "string": "string to_string stoi stol stoll stoul stoull stof stod getline char_traits u8string wstring erase erase_if",
    "string_view": "string_view",
    "system_error": "error_code errc error_condition system_error generic_category system_category make_error_code",
    "thread": "thread jthread this_thread",
    "tuple": "tuple tie make_tuple apply tuple_size ignore forward_as_tuple",
    "type_traits": """is_same_v is_same enable_if_t decay_t conditional_t remove_const_t remove_cvref_t remove_reference_t
        is_trivially_copyable_v is_floating_point_v is_integral_v is_signed_v is_unsigned_v is_enum_v is_empty_v is_base_of_v
        is_convertible_v is_invocable_v is_invocable_r_v underlying_type_t make_unsigned_t make_signed_t type_identity_t
        has_unique_object_representations_v is_standard_layout_v is_arithmetic_v is_void_v invoke_result_t true_type false_type
        is_constant_evaluated common_type_t is_default_constructible_v integral_constant bool_constant""",
    "typeindex": "type_index",
    "unordered_map": "unordered_map unordered_multimap erase_if",
    "unordered_set": "unordered_set unordered_multiset erase_if",
    "utility": "exchange in_place in_place_t in_place_index in_place_type cmp_less index_sequence make_index_sequence as_const",
    "valarray": "valarray",
    "variant": "variant get_if holds_alternative visit monostate variant_size_v variant_alternative_t",
    "vector": "vector erase erase_if",
    "concepts": "integral floating_point same_as convertible_to invocable unsigned_integral signed_integral",
    "compare": "strong_ordering weak_ordering partial_ordering",
    "format": "format",
    "source_location": "source_location",
}
# The C++ standard guarantees that the one header declares the other's names.
BRINGS = {
    "iostream": ["ostream", "istream", "ios", "streambuf"],
    "fstream": ["ios"], "sstream": ["ios"], "istream": ["ios", "ostream"], "ostream": ["ios"],
    **{name: ["initializer_list"] for name in ("algorithm", "array", "deque", "list", "map", "queue", "random", "set", "string",
                                               "unordered_map", "unordered_set", "utility", "valarray", "vector")},
}  # fmt: skip
# Names that are found without std::, because they are macros.
MACROS = {"errno", "FLT_MAX", "FLT_MIN", "FLT_EPSILON", "DBL_MAX", "DBL_MIN", "DBL_EPSILON", "INT_MAX", "INT_MIN", "UINT_MAX",
          "CHAR_BIT", "LONG_MAX", "SIGINT", "SIGTERM", "UINT64_MAX", "UINT32_MAX", "EXIT_SUCCESS", "EXIT_FAILURE"}  # fmt: skip

HEADERS_OF = {}
for _header, _names in DECLARES.items():
    for _name in _names.split():
        HEADERS_OF.setdefault(_name, set()).add(_header)
C_HEADERS = {name[1:] + ".h": name for name in DECLARES if name.startswith("c")}

INCLUDE = re.compile(r'^\s*#\s*include\s*(?:<([\w./]+)>|"([\w./]+)")', re.M)
NOT_CODE = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'', re.S)
# `for (x : {a, b})` uses std::initializer_list without naming it.
UNNAMED_LIST = re.compile(r"\bfor \([^;()]*[^:]:\s*\{")
USE = re.compile(r"\bstd::(?:ranges::)?(\w+)|\b(" + "|".join(sorted(MACROS)) + r")\b")
PLACES = ("Quake", "Shaders", ".")  # where an include in quotes is looked for


def code_of(text):
    """The text without comments and literals; line numbers do not change."""
    return NOT_CODE.sub(lambda m: "\n" * m.group(0).count("\n") or " ", text)


class Sources:
    def __init__(self, root):
        self.root = root

    @functools.lru_cache(maxsize=None)
    def text(self, path):
        return path.read_text(errors="replace")

    @functools.lru_cache(maxsize=None)
    def includes(self, path):
        """The direct includes of a file: names of standard headers, paths of the project's headers."""
        standard, ours = set(), set()
        for angled, quoted in INCLUDE.findall(self.text(path)):
            if angled:
                name = C_HEADERS.get(angled, angled)
                standard |= {name, *BRINGS.get(name, [])}
                continue
            places = (path.parent, *(self.root / place for place in PLACES))
            ours |= set(itertools.islice((p / quoted for p in places if (p / quoted).is_file()), 1))
        return standard, ours

    def standard_headers(self, path):
        """The standard headers that a file includes, directly or through the project's headers."""
        found, seen, waiting = set(), set(), [path]
        while waiting:
            at = waiting.pop()
            if at in seen:
                continue
            seen.add(at)
            standard, ours = self.includes(at)
            found |= standard
            waiting += ours
        return found

    def errors_of(self, path):
        """Yields (line, sentence): the first use of each name that no included header declares."""
        headers = self.standard_headers(path)
        seen = set()
        for number, line in enumerate(code_of(self.text(path)).split("\n"), 1):
            names = [a or b for a, b in USE.findall(line)] + ["initializer_list"] * bool(UNNAMED_LIST.search(line))
            for name in names:
                wanted = HEADERS_OF.get(name)
                if wanted is None or name in seen or wanted & headers:
                    continue
                seen.add(name)
                choice = " or ".join(f"<{h}>" for h in sorted(wanted))
                yield number, f"{'' if name in MACROS else 'std::'}{name} is of {choice}, which is not included"


def sources_of(root):
    listing = subprocess.run(
        ["git", "-C", str(root), "ls-files", "-z", "--cached", "--others", "--exclude-standard", "*.cpp", "*.h"],
        check=True, capture_output=True,
    ).stdout  # fmt: skip
    return [root / name for name in sorted(set(listing.decode().split("\0"))) if name and (root / name).is_file()]


def check(root):
    sources, failed = Sources(root), False
    for path in sources_of(root):
        for number, sentence in sources.errors_of(path):
            failed = True
            print(f"{path.relative_to(root)}:{number}: {sentence}", file=sys.stderr)
    return failed


def self_test():
    files = {
        "Quake/a/own.h": "#pragma once\n#include <vector>\nstd::vector<int> all();\n",
        "Quake/a/through.cpp": '#include "a/own.h"\nstd::vector<int> all() { return {}; }\n',
        "Quake/a/forgets.cpp": '#include "a/own.h"\n#include <fmt/format.h>\nint f() { return std::clamp(1, 2, 3); }\n',
        "Quake/a/names.cpp": "#include <algorithm>\n#include <errno.h>\nint f() { return std::clamp(errno, 2, 3); }\n",
        "Quake/a/says.cpp": '// std::clamp\nconst char* s = "std::clamp";\n/* std::sort\n */ const char* r = R"(std::min)";\n',
        "Quake/a/macro.cpp": "float f() { return FLT_MAX; }\n",
        "Quake/a/list.cpp": "void g(int);\nvoid f() {\n  for (const int x : {1, 2}) g(x);\n}\n",
        "Quake/a/ring.h": '#pragma once\n#include "a/gnir.h"\nstd::string ring();\n',
        "Quake/a/gnir.h": '#pragma once\n#include "a/ring.h"\n#include <string>\n',
    }
    expected = {("Quake/a/forgets.cpp", 3), ("Quake/a/macro.cpp", 1), ("Quake/a/list.cpp", 3)}
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder).resolve()
        for name, text in files.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text)
        sources = Sources(root)
        found = {(name, number) for name in files for number, _ in sources.errors_of(root / name)}
    if found != expected:
        print(f"check_includes.py: its self-test found {sorted(found)}, not {sorted(expected)}", file=sys.stderr)
        return True
    return False


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parent.parent)
    parser.add_argument("--self-test", action="store_true")
    options = parser.parse_args()
    return int(self_test() if options.self_test else check(options.root.resolve()))


if __name__ == "__main__":
    sys.exit(main())
