"""Small files that ask for gigabytes: the file is named, and nothing else comes to harm."""

from __future__ import annotations

from pathlib import Path

from command_line import refused

DEPTH, TIMES = 9, 10


def nested_forms(depth: int, times: int) -> bytes:
    """A PDF whose page draws a form, which draws another `times` times, and so on."""
    page = b"/Parent 2 0 R /MediaBox [0 0 500 500] /Contents 4 0 R"
    objects = [
        b"<< /Type /Catalog /Pages 2 0 R >>",
        b"<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
        b"<< /Type /Page " + page + b" /Resources << /XObject << /F 5 0 R >> >> >>",
        _stream(b"", b"/F Do"),
    ]
    form = b"/Type /XObject /Subtype /Form /BBox [0 0 500 500]"
    for number in range(6, 5 + depth):
        inner = b" /Resources << /XObject << /F %d 0 R >> >>" % number
        objects.append(_stream(form + inner, b"/F Do " * times))
    objects.append(_stream(form, b"0 0 500 500 re f " * 3))
    content, starts = b"%PDF-1.4\n", []
    for number, one in enumerate(objects, 1):
        starts.append(len(content))
        content += b"%d 0 obj\n%s\nendobj\n" % (number, one)
    table = b"".join(b"%010d 00000 n \n" % start for start in starts)
    size = len(objects) + 1
    head = b"xref\n0 %d\n0000000000 65535 f \n" % size
    tail = b"trailer << /Root 1 0 R /Size %d >>\nstartxref\n%d\n%%%%EOF\n" % (size, len(content))
    return content + head + table + tail


def _stream(said: bytes, content: bytes) -> bytes:
    return b"<< %s /Length %d >>\nstream\n%s\nendstream" % (said, len(content), content)


def test_forms_within_forms(tmp_path: Path) -> None:
    """A billion rectangles on one page, in a file of two kilobytes."""
    path = tmp_path / "house.pdf"
    path.write_bytes(nested_forms(DEPTH, TIMES))
    assert path.stat().st_size < 2500
    done = refused("plan", path, "-o", tmp_path / "out")
    assert done.returncode == 2
    assert "house.pdf" in done.stderr
    assert "2000 MB" in done.stderr
    assert "Traceback" not in done.stderr
