//! What stubs say of declarations, worked out by hand.

#![allow(clippy::unwrap_used)] // a test

use veduta_stubs::{stub, unformatted, StubError};

fn stub_of(source: &str) -> Result<String, StubError> {
    stub(&[("one.rs".to_string(), source.to_string())])
}

/// The part after the head, without white space.
fn told(source: &str) -> String {
    let whole = unformatted(&stub_of(source).unwrap());
    let (_, own) = whole.split_once("#one.rs").unwrap();
    own.to_string()
}

#[test]
fn a_function_has_its_arguments_defaults_and_result() {
    let source = r#"
        /// Adds.
        #[pyfunction]
        #[pyo3(signature = (a, b=None, *, c=1_000))]
        fn add(py: Python<'_>, a: &str, b: Option<f64>, c: usize) -> PyResult<Vec<[f64; 3]>> {}
        fn private(a: Nothing) {}
    "#;
    let expected = r#"def add(a: str, b: float | None = None, *, c: int = 1_000) -> list[list[float]]: """Adds.""""#;
    assert_eq!(told(source), unformatted(expected));
}

#[test]
fn what_python_gives_may_be_any_sequence() {
    let source = r#"
        type Pairs = Vec<(u32, [f32; 2])>;
        #[pyfunction]
        fn there_and_back(pairs: Pairs, more: &[u8]) -> Pairs {}
    "#;
    let expected =
        "def there_and_back(pairs: Sequence[tuple[int, tuple[float, float]]], more: bytes) \
                    -> list[tuple[int, list[float]]]: ...";
    assert_eq!(told(source), unformatted(expected));
}

#[test]
fn arrays_have_their_dtype_and_rank() {
    let source = r#"
        #[pyfunction]
        fn f<'py>(a: PyReadonlyArray2<'py, f32>) -> Bound<'py, PyArray1<bool>> {}
    "#;
    let expected = "def f(a: _Array2[np.float32]) -> _Array1[np.bool_]: ...";
    assert_eq!(told(source), unformatted(expected));
}

#[test]
fn classes_have_names_fields_and_methods() {
    let source = r#"
        create_exception!(_core, Bad, PyValueError);
        create_exception!(_core, Worse, Bad);
        #[derive(FromPyObject)]
        enum Given { Number(f64), Text(String) }
        #[pyclass(frozen, get_all, name = "Shown")]
        struct Hidden { size_m: f64 }
        #[pymethods]
        impl Hidden {
            #[new]
            fn new(given: HashMap<String, Given>) -> PyResult<Self> {}
            #[getter]
            fn other(&self) -> Option<Py<Hidden>> {}
            fn grow(&mut self, by: f64) {}
        }
    "#;
    let expected = "class Bad(ValueError): ...
        class Worse(Bad): ...
        class Shown:
            @property
            def size_m(self) -> float: ...
            def __new__(cls, given: dict[str, float | str]) -> Shown: ...
            @property
            def other(self) -> Shown | None: ...
            def grow(self, by: float) -> None: ...";
    assert_eq!(told(source), unformatted(expected));
}

#[test]
fn a_type_that_is_not_known_is_an_error() {
    let source = "#[pyfunction] fn f(a: Bound<'_, PyAny>) {}";
    let why = stub_of(source).unwrap_err().to_string();
    assert_eq!(
        why,
        "one.rs: f: the type `PyAny` has no counterpart in Python here"
    );
}

#[test]
fn a_name_that_two_files_give_to_types_is_an_error_in_a_third() {
    let file = |name: &str, text: &str| (name.to_string(), text.to_string());
    let one = file("a.rs", "type Pair = (f64, f64);");
    let two = file("b.rs", "type Pair = (u8, u8);");
    let used = file(
        "c.rs",
        "use crate::a::Pair; #[pyfunction] fn f() -> Pair {}",
    );
    assert!(stub(&[one.clone(), used.clone()]).is_ok());
    let why = stub(&[one, two, used]).unwrap_err().to_string();
    assert!(why.contains("`Pair`"), "{why}");
}

#[test]
fn a_signature_that_forgets_an_argument_is_an_error() {
    let source = "#[pyfunction] #[pyo3(signature = (a))] fn f(a: f64, b: f64) {}";
    assert!(matches!(
        stub_of(source),
        Err(StubError::Declaration { .. })
    ));
}
