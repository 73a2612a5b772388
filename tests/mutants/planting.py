"""What run and changed share: plants faults in copies of the source, one at a time, and tells who notices them.

A fault is a dict:
  id           what it is called in the output
  key          what it is known by from one time to the next
  file         what is changed
  at           where in there, in bytes
  text         what it is in there
  replacement  what stands there instead
  tests        the programs that should notice, in turn: ["sand", "measure:Furrow.*"]

Each job has a copy and a build of its own in build/mutants. Only the test programs that are asked for are built: the
first time takes as long as that does.
"""
import argparse, concurrent.futures, hashlib, json, os, pathlib, queue, re, shutil, signal, subprocess, sys, threading
import time

SOURCE = pathlib.Path(__file__).resolve().parent.parent.parent
BUILDS = SOURCE / "build" / "mutants"
LONGEST = 300  # seconds that a test program may take without a fault; five times what it then takes with one


def key_of(*parts):
    return hashlib.sha256("\0".join(map(str, parts)).encode()).hexdigest()


def tests_of(file):
    """Those of the file's folder; of the program, which takes long, those that are called as the file is."""
    path = pathlib.Path(file)
    folder = {"gl": "render"}.get(path.parent.name, path.parent.name)
    if folder != "cli":
        return [folder]
    tests = SOURCE / "tests" / "cli" / f"{path.stem.partition('_')[0]}_test.cpp"
    suites = re.findall(r"^TEST(?:_F|_P)?\((\w+),", tests.read_text(), re.M) if tests.exists() else []
    return ["cli:" + ":".join(f"{suite}.*" for suite in dict.fromkeys(suites)) if suites else "cli"]


def program_of(test):
    return "test_" + test.partition(":")[0]


class Copy:
    """The source and a build of it, in which one fault at a time is planted."""

    def __init__(self, number):
        self.source = BUILDS / str(number)
        self.build = self.source / "build" / "quick"
        self.scratch = self.source / "build" / "tmp"
        self.scratch.mkdir(parents=True, exist_ok=True)
        self.longest = {}  # seconds, of each test: a fault that never ends is noticed, too

    def configure(self):
        """As the source is now; what did not change keeps its time, so that it is not built again."""
        listed = subprocess.check_output(["git", "ls-files", "-co", "--exclude-standard"], cwd=SOURCE, text=True)
        files = {name for name in listed.splitlines() if (SOURCE / name).is_file()}
        for old in self.source.glob("[!b]*/**/*"):  # all but the build
            if old.is_file() and str(old.relative_to(self.source)) not in files:
                old.unlink()
        for name in files:
            self.put(name, (SOURCE / name).read_bytes())
            shutil.copymode(SOURCE / name, self.source / name)
        # Without unity, so that a fault is one file to compile; lightly optimised, for many of them are compiled.
        self.call(["cmake", "--preset", "release", "-B", str(self.build), "-DCMAKE_UNITY_BUILD=OFF",
                   "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG",
                   f"-DCMAKE_CXX_COMPILER_LAUNCHER={'ccache' if shutil.which('ccache') else ''}"], check=True)

    def make(self, programs, check=False):
        return self.call(["cmake", "--build", str(self.build), "--target", *sorted(programs)], check=check)[0]

    def put(self, name, content):
        path = self.source / name
        if path.exists() and path.read_bytes() == content:
            return
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)

    def noticed_by(self, fault):
        """The first test program that fails, "the compiler", or None."""
        original = (SOURCE / fault["file"]).read_bytes()
        self.put(fault["file"], with_fault(original, fault))
        try:
            for test in fault["tests"]:
                if not self.make([program_of(test)]):
                    return "the compiler"
                if not self.passes(test)[0]:
                    return test
            return None
        finally:
            self.put(fault["file"], original)

    def passes(self, test):
        _, _, tests = test.partition(":")
        shutil.rmtree(self.scratch)
        self.scratch.mkdir()
        passed, out = self.call([str(self.build / "tests" / program_of(test)), "--gtest_brief=1", "--gtest_fail_fast",
                                 f"--gtest_filter={tests or '*'}"], longest=self.longest.get(test, LONGEST))
        return passed and " 0 tests from " not in out, out

    def call(self, command, check=False, longest=None):
        """Whether it succeeded, in time, and what it said; what it started ends with it."""
        with subprocess.Popen(command, cwd=self.source, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              errors="replace", start_new_session=True, env=os.environ | {
                                  "TMPDIR": str(self.scratch), "CCACHE_BASEDIR": str(self.source)}) as process:
            try:
                out, _ = process.communicate(timeout=longest)
            except subprocess.TimeoutExpired:
                out = "took too long"
            finally:
                try:
                    os.killpg(process.pid, signal.SIGKILL)
                except ProcessLookupError:
                    pass
        if check and process.returncode != 0:
            sys.exit(f"mutants: failed: {' '.join(command)}\n{out[-4000:]}")
        return process.returncode == 0, out


def with_fault(original, fault):
    end = fault["at"] + len(fault["text"].encode())
    return original[:fault["at"]] + fault["replacement"].encode() + original[end:]


def options(doc, name):
    """A parser with the options that both scripts have. What was noticed is kept under the script's name."""
    parser = argparse.ArgumentParser(prog=f"tests/mutants/{name}", description=doc,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="copies that are built and tested at once")
    parser.add_argument("--again", action="store_true", help="only those that the last time survived, or had no turn")
    parser.set_defaults(results=BUILDS / f"{name}.json")
    return parser


def plant(faults, options):
    """Who noticed each fault, or None, by its key; also of those that were noticed before, where they have no turn."""
    noticed = json.loads(options.results.read_text()) if options.again and options.results.exists() else {}
    faults = [fault for fault in faults if not noticed.get(fault["key"])]
    start = time.monotonic()
    if faults:
        plant_all(faults, max(1, min(options.jobs, len(faults))), noticed, options.results)
    print(f"mutants: {(time.monotonic() - start) / 60:.0f} minutes", file=sys.stderr)
    return noticed


def plant_all(faults, jobs, noticed, results):
    tests = sorted({test for fault in faults for test in fault["tests"]})
    copies = queue.Queue()
    for number in range(jobs):
        copy = Copy(number)
        print(f"mutants: building copy {number + 1} of {jobs}", file=sys.stderr)
        copy.configure()
        copy.make({program_of(test) for test in tests}, check=True)
        copies.put(copy)
    first = copies.get()
    longest = {}
    for test in tests:  # or a fault would be noticed by a test that fails anyway
        start = time.monotonic()
        passed, out = first.passes(test)
        longest[test] = 10 + 5 * (time.monotonic() - start)
        if not passed:
            sys.exit(f"mutants: {test} fails, or matches no test, without any fault; mend it first\n{out[-4000:]}")
    copies.put(first)
    for copy in copies.queue:
        copy.longest = longest

    lock, turns = threading.Lock(), iter(range(1, len(faults) + 1))

    def try_out(fault):
        copy = copies.get()
        try:
            by = copy.noticed_by(fault)
        finally:
            copies.put(copy)
        with lock:
            noticed[fault["key"]] = by
            results.write_text(json.dumps(noticed))
            print(f"[{next(turns)}/{len(faults)}] {fault['id']:<12} {by or 'SURVIVES'}", file=sys.stderr, flush=True)

    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        list(pool.map(try_out, faults))
