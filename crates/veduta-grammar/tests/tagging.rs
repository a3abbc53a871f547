//! Tags of single faces, and where scopes lie after `extrude`: hand-worked truth on a lot of 10 x 6 m.

use crate::support::said;

/// What is printed of the area that a query picks from a shape.
fn area(operations: &str, query: &str) -> f64 {
    let text = format!(
        "Lot --> {operations} print(sum(comp(f) {{ isTagged(\"{query}\") : geometry.area }}))"
    );
    said(&text)[0].parse().unwrap_or(f64::NAN)
}

#[test]
fn faces_are_tagged_by_what_made_them() {
    for (operations, query, truth) in [
        ("extrude(3)", "extrude.top", 60.0),
        ("extrude(3)", "extrude.bottom", 60.0),
        ("extrude(3)", "extrude.side", 96.0),
        ("extrude(3)", "extrude.side.outer", 96.0),
        ("extrude(3)", "extrude.?.outer", 96.0),
        ("extrude(3)", "extrude", 216.0),
        ("extrude(3)", "*.outer", 96.0),
        ("extrude(3)", "extru", 0.0),
        ("extrude(3) deleteTags()", "extrude", 0.0),
        ("extrude(3) tag(\"a.b\")", "a", 216.0),
        ("extrude(3) tag(\"a.b\") deleteTags(\"a\")", "a", 0.0),
        ("taper(3)", "taper.bottom", 60.0),
        ("envelope(normal, 3, 3, 90)", "envelope.side.base", 96.0),
        ("envelope(normal, 3, 3, 90)", "envelope.top", 60.0),
        ("roofGable(byHeight, 3, 0, 0)", "roof.side", 18.0),
        ("roofGable(byHeight, 3, 0, 0)", "roof.bottom", 60.0),
    ] {
        let found = area(operations, query);
        assert!(
            (found - truth).abs() < 1e-9,
            "{operations} {query}: {found}"
        );
    }
}

#[test]
fn another_geometry_has_no_tags_of_the_one_before() {
    let union = "union { t(2, 1, 1) s(2, 2, 2) primitiveCube() }";
    let top = "comp(f) { isTagged(\"extrude.top\") : Top | all : NIL } Top --> tag(\"own\")";
    for replaced in [
        "primitiveCube()",
        "primitiveQuad()",
        "primitiveDisk(8)",
        "primitiveCylinder(8, 1, 2)",
        "primitiveCone()",
        "primitiveSphere(8, 4)",
        "resetGeometry()",
    ] {
        for made in ["extrude(3)", "taper(3)", "roofGable(30)", union] {
            for query in ["extrude", "taper", "roof", "bool"] {
                let found = area(&format!("{made} {replaced}"), query);
                assert_eq!(found, 0.0, "{made} {replaced} {query}");
            }
        }
        // A face has its tags for itself; what rules tag stays.
        assert_eq!(
            area(&format!("extrude(3) {top} {replaced}"), "extrude"),
            0.0
        );
        let own = area(&format!("extrude(3) {top} {replaced}"), "own");
        assert!(own > 1.0, "{replaced}: {own}");
        let again = area(&format!("taper(3) {replaced} extrude(2)"), "extrude.top");
        assert!(again > 1.0, "{replaced}: {again}");
    }
}

#[test]
fn booleans_tag_what_is_left_of_both() {
    // A cube of 2 m of which 1 m lies in a corner of the block of 10 x 3 x 6 m.
    let cube = "{ t(9, 2, 5) s(2, 2, 2) primitiveCube() tag(\"cube\") }";
    for (operation, a, b) in [
        ("union", 216.0 - 3.0, 24.0 - 3.0),
        ("subtract", 216.0 - 3.0, 3.0),
        ("intersect", 3.0, 3.0),
    ] {
        let operations = format!("extrude(3) {operation} {cube}");
        for (query, truth) in [("bool.A", a), ("bool.B", b), ("cube", b)] {
            let found = area(&operations, query);
            assert!((found - truth).abs() < 1e-6, "{operation} {query}: {found}");
        }
        let moved = format!("{operations} t(3, 1, -2) r(0, 30, 0)");
        assert!(
            (area(&moved, "bool.B") - b).abs() < 1e-6,
            "{operation}, moved"
        );
    }
}

#[test]
fn what_is_put_together_keeps_the_tags_of_its_parts() {
    let parts = "inline(append) split(x) { 4 : tag(\"left\") A. | ~1 : tag(\"right\") B. }";
    assert!((area(parts, "left") - 24.0).abs() < 1e-9);
    assert!((area(parts, "right") - 36.0).abs() < 1e-9);
}

#[test]
fn y_of_the_scope_lies_along_what_was_extruded() {
    let wall = "Lot --> extrude(3) comp(f) { front : Wall | all : NIL } Wall -->";
    let sizes = "print(scope.sx) print(scope.sy) print(scope.sz)";
    assert_eq!(
        said(&format!("{wall} extrude(0.5) {sizes}")),
        ["10", "0.5", "3"]
    );
    assert_eq!(
        said(&format!("{wall} extrude(z, 0.5) {sizes}")),
        ["10", "3", "0.5"]
    );
    let out = "extrude(0.5) comp(f) { top : print(geometry.area) | all : NIL }";
    assert_eq!(said(&format!("{wall} {out}")), ["30"]);
    // The same from faces that are no rectangles.
    let disk = "s('1, 0, 3) r(90, 0, 0) primitiveDisk(8) extrude(0.5) print(scope.sy)";
    assert_eq!(said(&format!("Lot --> {disk}")), ["0.5"]);
}

#[test]
fn scopes_of_faces_may_have_the_axes_of_the_shape() {
    let roof =
        "Lot --> roofGable(byHeight, 3, 0, 0) comp(f, noAlign) { isTagged(\"roof.bottom\") : ";
    assert_eq!(
        said(&format!(
            "{roof} print(scope.sx) print(scope.sz) | all : NIL }}"
        )),
        ["10", "6"]
    );
}

#[test]
fn parts_without_an_asset_are_the_shape() {
    let text = "Lot --> extrude(3) set(material.name, \"brick\") print(str(geometry.materials)) \
                print(size(geometry.groups)) comp(g) { all : print(geometry.nFaces) }";
    assert_eq!(said(text), ["[brick]", "1", "6"]);
}

/// Tags and queries come from files: many parts and many stars are answered at once.
#[test]
fn many_stars_are_soon_answered() {
    let operations = format!("extrude(3) tag(\"{}\")", vec!["a"; 40].join("."));
    let stars = vec!["*"; 30].join(".");
    assert_eq!(area(&operations, &format!("{stars}.b")), 0.0);
    assert_eq!(area(&operations, &stars), 216.0);
}
