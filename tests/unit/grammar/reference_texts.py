"""What the reference prints beside its examples of texts and numbers: see `reference_values.py`."""

from __future__ import annotations

from reference_page import Page

_CITY = '"rule your city with cityengine"'
_ROCKS = '"cityengine rocks my world; cityengine should rock yours too"'
_YOURS = '"rule;your;designs;and;your;cities;"'

TEXTS: dict[str, Page] = {
    "func_isnull": Page(
        "",
        (
            ('isNull("CityEngine")', "false"),
            ('isNull("\\ue000")', "true"),
            ("isNull(ln(-1))", "true"),
            ('isNull(["CityEngine", "\\ue000"])', "[false,true]"),
        ),
    ),
    "func_isinf": Page(
        "",
        (("isinf(1/0)", "true"), ("isinf(ln(0))", "true"), ("isinf(ln(-1))", "false")),
    ),
    "func_str": Page(
        "",
        (
            ("str(1.69)", "1.69"),
            ("str(1.69 - 69/100)", "1"),
            ("str(001)", "1"),
            ("str(true)", "true"),
        ),
    ),
    "func_bool": Page(
        "",
        (
            ("bool(1)", "true"),
            ("bool(0)", "false"),
            ('bool("1")', "true"),
            ("bool(6.66)", "true"),
            ('bool("false")', "false"),
            ('bool("f")', "false"),
            ('bool("true")', "true"),
            ('bool("beneath the remains")', "true"),
            ("bool(11.5 == 0)", "false"),
        ),
    ),
    "func_float": Page(
        "",
        (
            ('float("0.5")', "0.5"),
            ("float(true)", "1"),
            ('float("001.5")', "1.5"),
            ("float(1/0)", "inf"),
        ),
    ),
    "func_floatArray": Page(
        "",
        (
            ("floatArray([1, 0, 1.777, 20])", "[1,0,1.777,20]"),
            ('floatArray(["1.5", "-2", "0", "nixda", "5+6"])', "[1.5,-2,0,nan,5]"),
            ("floatArray([true, false, true])", "[1,0,1]"),
        ),
    ),
    "func_boolArray": Page(
        "",
        (
            ("boolArray([1, 0, 1, 20])", "[true,false,true,true]"),
            (
                'boolArray(["true", "1", "0", "f", "false", "schwiizer nati"])',
                "[true,true,false,false,false,true]",
            ),
            ("boolArray([true, false, true])", "[true,false,true]"),
        ),
    ),
    "func_stringArray": Page(
        "",
        (
            ("stringArray([1, 0, 1.777, 20])", "[1,0,1.777,20]"),
            ('stringArray(["true", "CityEngine", ""])', "[true,CityEngine,]"),
            ("stringArray([true, false, true])", "[true,false,true]"),
        ),
    ),
    "func_find": Page(
        "",
        (
            ('find("CE_Zero CE_One CE_Two", "CE", 0)', "0"),
            ('find("CE_Zero CE_One CE_Two", "CE", 1)', "8"),
            (f'find({_ROCKS}, "cityengine", 0)', "0"),
            (f'find({_ROCKS}, "cityengine", 1)', "27"),
            ('find("CE_Zero CE_One CE_Two", "asdf", 1)', "-1"),
        ),
    ),
    "func_count": Page(
        "", (('count("cityengine", "e")', "2"), (f'count({_ROCKS}, "cityengine")', "2"))
    ),
    "func_substring": Page(
        "",
        (
            ('substring("0123456789", 0, 5)', "01234"),
            ('substring("0123456789", 2, 5)', "234"),
            ('substring("0123456789", -20, 5)', "01234"),
            ('substring("0123456789", 0, 20)', "0123456789"),
            ('substring("0123456789", 5, 0)', ""),
        ),
    ),
    "func_p": Page("", (("p(1)", "true"), ("p(0)", "false"), ("p(2)", "true"), ("p(-1)", "false"))),
    "celib/findFirst": Page("", ((f'findFirst({_CITY},"city")', "10"),)),
    "celib/findLast": Page("", ((f'findLast({_CITY},"city")', "20"),)),
    "celib/getPrefix": Page(
        "",
        (
            (f'getPrefix({_CITY},"city")', "rule your "),
            ('getPrefix("myTexture.has.prefix.jpg",".")', "myTexture"),
        ),
    ),
    "celib/getRange": Page(
        "",
        (
            (f'getRange({_CITY},"y","city")', "our city with "),
            ('getRange("myTexture.hasName.001.jpg","hasName.",".jpg")', "001"),
            ('getRange("myTexture.hasName.001.jpg",".",".")', "hasName.001"),
            ('getRange("CityEngine","CityEn","tyEngine")', ""),
        ),
    ),
    "celib/getSuffix": Page("", ((f'getSuffix({_CITY},"city")', "engine"),)),
    "celib/replace": Page(
        "",
        (
            (f'replace({_CITY},"your city","designs")', "rule designs with cityengine"),
            ('replace("myTexture.#.jpg","#","1")', "myTexture.1.jpg"),
        ),
    ),
    "celib/listAdd": Page(
        "",
        (
            ('listAdd("rule;your;","city")', "rule;your;city;"),
            ('listAdd("rule;your;","city;")', "rule;your;city;"),
        ),
    ),
    "celib/listClean": Page(
        "",
        (
            ('listClean(";;;;;my;city;rules;;your;;city;;")', "my;city;rules;your;city;"),
            ('listClean(";;cityengine;;;rules")', "cityengine;rules;"),
        ),
    ),
    "celib/listCount": Page(
        "",
        (
            ('listCount("rule;your;city;","city")', "1"),
            ('listCount("city;cityengine;city;", "city")', "2"),
            ('listCount("rule;your;city;","*y*")', "2"),
            ('listCount("rule;your;city;","*y")', "1"),
        ),
    ),
    "celib/listFirst": Page("", (('listFirst("rule;your;city;")', "rule"),)),
    "celib/listLast": Page("", (('listLast("rule;your;city;")', "city"),)),
    "celib/listIndex": Page(
        "",
        (
            ('listIndex("rule;your;city;","city")', "2"),
            ('listIndex("rule;your;city;","*y")', "2"),
            ('listIndex("rule;your;city;","*y*")', "1"),
        ),
    ),
    "celib/listItem": Page(
        "",
        (
            ('listItem("rule;your;city;",2)', "city"),
            ('listItem("texture_1.jpg;texture_2.jpg;texture_3.jpg;",0)', "texture_1.jpg"),
        ),
    ),
    "celib/listRange": Page(
        "", (('listRange("rule;your;city;with;cityengine;",0,3)', "rule;your;city;"),)
    ),
    "celib/listRemove": Page(
        "",
        (
            ('listRemove("rule;your;city;","your")', "rule;city;"),
            ('listRemove("rule;your;city;","*u*")', "your;city;"),
            ('listRemove("floor_1;floor_2;floor_3;", "*_2")', "floor_1;floor_3;"),
        ),
    ),
    "celib/listRemoveAll": Page(
        "",
        (
            (f'listRemoveAll({_YOURS},"your")', "rule;designs;and;cities;"),
            (f'listRemoveAll({_YOURS},"*u*")', "designs;and;cities;"),
        ),
    ),
    "celib/listRetainAll": Page(
        "",
        (
            (f'listRetainAll({_YOURS},"*s")', "designs;cities;"),
            ('listRetainAll("floor;floor_1;floor_2;", "*_*")', "floor_1;floor_2;"),
        ),
    ),
    "celib/listSize": Page("", (('listSize("cityengine;rules;")', "2"),)),
    "celib/listToArray": Page(
        "",
        (
            ('floatArray(listToArray("1;2;3;"))', "[1,2,3]"),
            ('boolArray(listToArray("true;false;true;"))', "[true,false,true]"),
            ('listToArray("rule;your;city;")', "[rule,your,city]"),
        ),
    ),
    "celib/listFromArray": Page(
        "",
        (
            ("listFromArray([1,2,3])", "1;2;3;"),
            ("listFromArray([true,false,true])", "true;false;true;"),
            ('listFromArray(["rule","your","city"])', "rule;your;city;"),
        ),
    ),
    "celib/colorHSVToHex": Page("", (("colorHSVToHex(90,0.5,0.5)", "#608040"),)),
    "celib/colorHSVOToHex": Page("", (("colorHSVOToHex(90,0.5,0.5,0.5)", "#60804080"),)),
    "celib/colorHexToH": Page(
        "", (('colorHexToH("#608040")', "90"), ('colorHexToH("#60804080")', "90"))
    ),
    "celib/clamp": Page("", (("clamp(1.5, 0, 1)", "1"), ("clamp(-11, -10, 10)", "-10"))),
    "celib/max": Page("", (("max(10, -10)", "10"), ('max("abc", "def")', "def"))),
    "celib/fileBasename": Page(
        "", (('fileBasename("assets/obj/mygeometry.01.obj")', "mygeometry.01"),)
    ),
    "celib/fileDirectory": Page(
        "", (('fileDirectory("assets/obj/mygeometry.01.obj")', "assets/obj/"),)
    ),
    "celib/fileExtension": Page("", (('fileExtension("assets/obj/mygeometry.01.obj")', "obj"),)),
    "celib/fileName": Page(
        "", (('fileName("assets/obj/mygeometry.01.obj")', "mygeometry.01.obj"),)
    ),
}
