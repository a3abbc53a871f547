//! The rule files in `rules/` are without faults.

use veduta_grammar::{check, Program, Source};

const LIBRARY: &str = r#"
attr height = 3
attr crownColor = "green"
f(x) = [x]
Tree(size) --> s(size, size, size)
start Main --> Cap(2)
Cap(a) --> extrude(a)
extension Column --> NIL
extension Cap(a, b) --> NIL
attr width = 1
style Dark
"#;

/// The faults of a file whose imports all get [`LIBRARY`].
fn faults(name: &str, text: &str) -> String {
    let program = Program::load(Source::new(name, text), |path, _| {
        Ok(Source::new(path, LIBRARY))
    });
    check(&program).render(&program)
}

#[test]
fn the_haussmann_facade_is_sound() {
    let text = include_str!("rules/haussmann.cga");
    assert_eq!(faults("haussmann.cga", text), "");
}

#[test]
fn the_house_is_sound() {
    assert_eq!(faults("house.cga", include_str!("rules/house.cga")), "");
}

#[test]
fn the_file_with_everything_is_sound() {
    let text = include_str!("rules/everything.cga");
    assert_eq!(faults("everything.cga", text), "");
}

/// Layouts and short forms as they are common in files of others.
#[test]
fn a_hasty_file_is_sound() {
    let text = r#"
import SU : 	"setup.cga"
attr h1		= rint(rand(2,3))
attr total=	75%:	h1*floorHeight
		else:	2*floorHeight
attr floorHeight	= rand(2.3,3)
#-----------------
Start -->	//color(0,1,0) /
	setback(3){all = NIL | remainder = shapeO(1,2,3,4){shape: alignScopeToGeometry(yUp,largest, longest) Body | remainder: NIL}}
Body-->	comp(f){street.front : Side(scope.sx, 1) | top = Lot1}
Lot1 -->case scope.sx < 16 || scope.sz < 16 : splitArea(x){ '(1/(rint(rand(1,2)))): Lot2}*
	else : alignScopeToGeometry(yUp,any, 0) splitArea(x){ '(1/(rint(rand(2,scope.sx/15)))): Lot2}*
Lot2 --> roofGable(40, 0 /**0.75*/, 0) split(y) {~2 : X. | ~2: NIL }
	comp(e){eave: X.} //end
Side(w, inx) --> split(y){ 0.5: Tile(split.index, inx) | {~floorHeight : Tile(split.index+4, inx) }* }
Tile(floorIndex, inx) -->
case floorIndex == 0: Wall
/**case floorIndex == 1 : Door*/
case scope.sx < 0.5 || inside() || touches : Wall
else: 		case inx==1 : 65%: Wall Door(scope.sx)
		else: Wall
else: Door(w(2)) Wall
w(a)=a-1
const use = 50%: 1
	else: 2
Wall-->i("a.obj")t(0,0,-scope.sz+0.12) SU.Cap(4)
Door(sx) -->		s('1,'1,0.1) t(sx + 0.1,1,(-scope.sz+0.05)) door.
	X./*a*/ Y.//b
"#;
    assert_eq!(faults("hasty.cga", text), "");
}
