//! Arrays, strings and materials in expressions: the examples of the reference, and hand-worked truth.

#![allow(clippy::unwrap_used)] // helpers of tests

use crate::support::{fault, said};

fn shown(values: &str) -> Vec<String> {
    said(&format!(
        "const a = [1, 2, 3, 4]\nconst b = [1, 2, 3; 4, 5, 6; 7, 8, 9]\nconst w = [\"x\", \"y\"]\n\
         Lot --> {values}"
    ))
}

fn each(values: &[&str]) -> Vec<String> {
    let all: String = values
        .iter()
        .map(|one| format!(" print(str({one}))"))
        .collect();
    shown(&all)
}

#[test]
fn single_elements() {
    assert_eq!(
        each(&["a[0]", "a[3]", "b[1, 1]", "b[3]"]),
        ["1", "4", "5", "4"]
    );
    assert_eq!(each(&["a[-1]", "a[4]", "b[0, 3]", "b[3, 0]"]), ["0"; 4]);
    assert_eq!(
        each(&["\"<\" + w[2] + \">\"", "[true][1]"]),
        ["<>", "false"]
    );
}

#[test]
fn arrays_as_indexes() {
    let values = [
        "a[[0, 2]]",
        "a[[1, 1]]",
        "a[3:-1:1]",
        "a[[0, 1; 2, 3]]",
        "b[1, [0, 2]]",
        "b[[0, 0, 1], 2]",
        "b[0:2, [0, 2]]",
        "b[[2, 3], -1:1]",
        "b[0, [0, 1; 2, 3]]",
    ];
    let truth = [
        "[1,3]",
        "[2,2]",
        "[4,3,2]",
        "[1,2;3,4]",
        "[4,6]",
        "[3;3;6]",
        "[1,3;4,6;7,9]",
        "[0,7,8;0,0,0]",
        "[1,2,3,0]",
    ];
    assert_eq!(each(&values), truth);
    let values = [
        "a[[true, false, true]]",
        "a[a .> 2]",
        "a[a .> 1 .&& a .<= 3]",
        "b[[false, true, true], 0]",
        "a[[false, false, true, true, true]]",
    ];
    assert_eq!(
        each(&values),
        ["[1,3]", "[3,4]", "[2,3]", "[4;7]", "[3,4,0]"]
    );
}

#[test]
fn arrays_in_arrays() {
    let values = [
        "[a, 5]",
        "[floatArray, 1]",
        "[[1; 2], [3; 4]]",
        "[a; 5:8]",
        "size([a, a])",
    ];
    let truth = ["[1,2,3,4,5]", "[1]", "[1,3;2,4]", "[1,2,3,4;5,6,7,8]", "8"];
    assert_eq!(each(&values), truth);
    assert!(fault("Lot --> print([[1; 2], 3])").contains("rows beside each other"));
    assert!(fault("Lot --> print([1, 2; 3])").contains("a row has 1"));
    let sieve = "primes(max) = case max <= 1 : floatArray else : sift(sqrt(max), [2 : max], floatArray)\n\
                 sift(limit, a, found) = case a[0] <= limit : sift(limit, a[a .% a[0] .!= 0], [found, a[0]])\n\
                 else : [found, a]\nLot --> print(primes(20))";
    assert_eq!(said(sieve), ["(8)[2,3,5,7,11,13,17,19]"]);
}

#[test]
fn arrays_in_order() {
    let rows = "[4, 0, 1; 2, 1, 9; 1, 3, 0; 2, 1, 0]";
    let values = [
        format!("sortRowIndices({rows})"),
        format!("{rows}[sortRowIndices({rows}), 0:2]"),
        "sortIndices([3, 1, 2])".to_string(),
    ];
    let values: Vec<&str> = values.iter().map(String::as_str).collect();
    let truth = ["[2,3,1,0]", "[1,3,0;2,1,0;2,1,9;4,0,1]", "[1,2,0]"];
    assert_eq!(each(&values), truth);
}

#[test]
fn parts_of_strings() {
    let city = "\"rule your city with cityengine\"";
    let values = [
        format!("getPrefix({city}, \"city\")"),
        format!("getSuffix({city}, \"city\")"),
        format!("getRange({city}, \"y\", \"city\")"),
        format!("findFirst({city}, \"city\")"),
        "getRange(\"a.hasName.001.jpg\", \".\", \".\")".to_string(),
        "\"<\" + getRange(\"CityEngine\", \"CityEn\", \"tyEngine\") + \">\"".to_string(),
        "\"<\" + getPrefix(\"abc\", \"x\") + getSuffix(\"abc\", \"x\") + \">\"".to_string(),
        "fileDirectory(\"assets/obj/mine.01.obj\")".to_string(),
        "fileExtension(\"assets/obj/mine.01.obj\")".to_string(),
        "isNull(\"\")".to_string(),
    ];
    let values: Vec<&str> = values.iter().map(String::as_str).collect();
    let truth = [
        "rule your ",
        "engine",
        "our city with ",
        "10",
        "hasName.001",
        "<>",
        "<>",
        "assets/obj/",
        "obj",
        "false",
    ];
    assert_eq!(each(&values), truth);
}

#[test]
fn frames() {
    // The scope turned a quarter about y and moved: its x looks against the world's z.
    let turned = "r(0, 90, 0) t(2, 0, 0)";
    let values = "print(convert(scope, world, pos, [1, 0, 0])) print(convert(z, scope, object, pos, 1, 0, 0)) \
                  print(convert(world, scope, pos, [0, 0, -3])) print(convert(scope, world, orient, [0, 0, 0])) \
                  print(convert(y, object, scope, orient, 0, 90, 0))";
    let truth = ["(3)[0,0,-3]", "-3", "(3)[1,0,0]", "(3)[0,90,0]", "0"];
    assert_eq!(shown(&format!("{turned} {values}")), truth);
}

#[test]
fn assets_tell_their_size() {
    let values = [
        "assetInfo(\"brick.obj\", sx)",
        "assetInfo(\"brick.obj\", ty)",
    ];
    assert_eq!(each(&values), ["2", "0"]);
    assert!(fault("Lot --> print(assetInfo(\"bok\", sx))").contains("`bok`"));
}

#[test]
fn materials_are_set_and_read() {
    let set = "setMaterial([\"color.r\", \"1.0\", \"color.g\", 0, \"roughness\", 0.25, \"shader\", \"X\"])";
    let values = "print(material.color.rgb) print(material.roughness) print(material.shader) \
                  print(material.shininess) print(str(getMaterial(used, changed)))";
    let truth = [
        "#ff00ff",
        "0.25",
        "X",
        "1",
        "[color.g,0;shader,X;roughness,0.25]",
    ];
    assert_eq!(shown(&format!("{set} {values}")), truth);
    // What has been read can be set again.
    let again = "color(0, 0.5, 1) A(getMaterial(used, all))\n\
                 A(all) --> color(1, 1, 1) setMaterial(all) print(material.color.b) print(material.color.r)";
    assert_eq!(said(&format!("Lot --> {again}")), ["1", "0"]);
    let reset = "set(material.metallic, 1) resetMaterial() print(material.metallic)";
    assert_eq!(shown(reset), ["0"]);
    let odd = fault("Lot --> setMaterial([\"color.r\"])");
    assert!(odd.contains("no value after it"), "{odd}");
    let unknown = fault("Lot --> setMaterial([\"colour\", 1])");
    assert!(unknown.contains("`material.colour`"), "{unknown}");
    assert!(fault("Lot --> set(material.opacity, \"thick\")").contains("a number from 0 to 1"));
}

#[test]
fn arrays_are_compared_as_wholes() {
    // The examples of the reference.
    let holds = [
        "[1, 2] == [1, 2]",
        "[1, 2] != [1; 2]",
        "[\"a\", \"b\"] != [\"a\"; \"b\"]",
        "[true, true] != [true, false]",
        "[1, 2] < [1, 3]",
        "[1, 2] <= [1, 2]",
        "[1, 3] > [1, 2]",
        "[\"a\"; \"b\"] > [\"a\"]",
        "[1, 2, 3] >= [1, 2]",
        "[\"a\"; \"b\"] >= [\"a\"; \"b\"]",
    ];
    assert_eq!(each(&holds), ["true"; 10]);
    let fails = [
        "[\"a\", \"b\"] == [\"a\"; \"b\"]",
        "[true, false] == [true, true]",
        "[\"a\", \"b\"] < [\"a\"; \"b\"]",
        "[\"a\"; \"b\"] <= [\"a\"]",
        "[1, 2, 3] == [1, 2]",
    ];
    assert_eq!(each(&fails), ["false"; 5]);
    // With a dot, element by element.
    let elements = ["[1, 2] .== [1, 3]", "[1, 2] .< [2, 1]"];
    assert_eq!(each(&elements), ["[true,false]", "[true,false]"]);
}

#[test]
fn a_string_and_an_array_are_one_string() {
    let values = [
        "\"a: \" + [1, 2; 3, 4]",
        "[true] + \" b\"",
        "\"a\" .+ [1, 2]",
    ];
    assert_eq!(each(&values), ["a: [1,2;3,4]", "[true] b", "[a1,a2]"]);
}

#[test]
fn arrays_of_another_kind() {
    // The examples of the reference.
    let values = [
        "floatArray([1, 0, 1.777, 20])",
        "floatArray([\"1.5\", \"-2\", \"0\", \"nixda\", \"5+6\"])",
        "floatArray([true, false, true])",
        "stringArray([1, 0, 1.777, 20])",
        "stringArray([true, false, true])",
        "floatArray([\"1\", \"2\"; \"3\", \"4\"])",
        "boolArray([\"true\", \"\"])",
        "size(floatArray())",
        "float(\"12.5 m\")",
    ];
    assert_eq!(
        each(&values),
        [
            "[1,0,1.777,20]",
            "[1.5,-2,0,nan,5]",
            "[1,0,1]",
            "[1,0,1.777,20]",
            "[true,false,true]",
            "[1,2;3,4]",
            "[true,true]",
            "0",
            "12.5",
        ]
    );
}

#[test]
fn empty_arrays_keep_their_kind() {
    let found = said(
        "const not = !boolArray()\nconst joined = stringArray() .+ \"a\"\n\
         const turned = transpose(stringArray())\nconst less = floatArray() .< 2\n\
         const missing = isnan(floatArray())\nconst sums = floatArray() .+ 1\n\
         Lot --> print(not[0]) print(\"<\" + joined[0] + \">\") print(\"<\" + turned[0] + \">\")\n\
         print(less[0]) print(missing[0]) print(sums[0])",
    );
    assert_eq!(found, ["false", "<>", "<>", "false", "false", "0"]);
}
