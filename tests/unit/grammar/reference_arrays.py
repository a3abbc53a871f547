"""What the reference prints beside its examples of arrays: see `reference_values.py`."""

from __future__ import annotations

from reference_page import Page

_ABC = 'array = ["B", "C", "D"]\n'
_TWO = "a = [-1 ; -2]\nb = [0:2 ; 3, 3, 3]\n"
_INDEXED = "array = [1,2,3,4]\ntable = [1,2,3; 4,5,6; 7,8,9]\n"
_SET = "line = [0,0,0,0,0,0]\nsquare = [0,0,0; 0,0,0; 0,0,0]\nsequence = [1:7]\npair = [1,1]\n"

ARRAYS: dict[str, Page] = {
    "arrayTypes": Page(
        "array1d = [1,2,3]\narray2d = [1,2;3,4]\n",
        (
            ("array1d[1]", "2"),
            ("array2d[1,0]", "3"),
            ("[1:5]", "[1,2,3,4,5]"),
            ("[1:2:5]", "[1,3,5]"),
            ("[1,2] == [1,2]", "true"),
            ('["a","b"] == ["a";"b"]', "false"),
            ("[true,false] == [true,true]", "false"),
            ("[1,2] != [1;2]", "true"),
            ('["a","b"] != ["a";"b"]', "true"),
            ("[true,true] != [true,true]", "false"),
            ("[1,2] < [1,3]", "true"),
            ('["a","b"] < ["a";"b"]', "false"),
            ("[1,2] <= [1,2]", "true"),
            ('["a";"b"] <= ["a"]', "false"),
            ("[1,3] > [1,2]", "true"),
            ('["a";"b"] > ["a"]', "true"),
            ("[1,2,3] >= [1,2]", "true"),
            ('["a";"b"] >= ["a";"b"]', "true"),
            (".![true,false]", "[false,true]"),
            ("[true,false] .|| true", "[true,true]"),
            ("false .|| [false;true]", "[false;true]"),
            ("[false,true] .|| [false,false]", "[false,true]"),
            ("[false;true] .&& true", "[false;true]"),
            ("false .&& [true;true;true]", "[false;false;false]"),
            ("[true,false] .&& [false,true]", "[false,false]"),
            ("[1,2] .+ 1", "[2,3]"),
            ("1 .+ [1;2]", "[2;3]"),
            ("[1,2] .+ [2,1]", "[3,3]"),
            (".+[1,2]", "[1,2]"),
            ("[1,2;3,4] .- 1", "[0,1;2,3]"),
            ("3 .- [1,2]", "[2,1]"),
            ("[3;2] .- [2;1]", "[1;1]"),
            (".-[1;2]", "[-1;-2]"),
            ("[4,2] .* 2.5", "[10,5]"),
            ("-4 .* [0.25;-0.75;-1]", "[-1;3;4]"),
            ("[1,2;3,4] .* [4,3;2,1]", "[4,6;6,4]"),
            ("[4;3] ./ 2", "[2;1.5]"),
            ("12 ./ [2,3,4]", "[6,4,3]"),
            ("[1.6,3.8] ./ [0.8,1.9]", "[2,2]"),
            ("[8;-5;0] .% 3", "[2;-2;0]"),
            ("7 .% [2.7,-3]", "[1.6,1]"),
            ("[-5,3.8] .% [-3,0.7]", "[-2,0.3]"),
            ("1 .== [1,2]", "[true,false]"),
            ('["a","b"] .== "b"', "[false,true]"),
            ("[true;false] .== [true;false]", "[true;true]"),
            ("[1,1;2,2] .!= [1,2;1,2]", "[false,true;true,false]"),
            ('["a"] .!= "a"', "[false]"),
            ("false .!= [true]", "[true]"),
            ("1 .< [1,2]", "[false,true]"),
            ('["a","b"] .< "b"', "[true,false]"),
            ("[1,2;2,1] .< [2,1;1,2]", "[true,false;false,true]"),
            ("1 .<= [1,2]", "[true,true]"),
            ('["a";"b";"c"] .<= "b"', "[true;true;false]"),
            ('["a","b"] .<= ["b","a"]', "[true,false]"),
            ("[1,2;3,4] .> [1,1;3,3]", "[false,true;false,true]"),
            ('"a" .> ["a";"a"]', "[false;false]"),
            ('["a";"b"] .> "a"', "[false;true]"),
            ("[1;2;3] .>= [2;2;2]", "[false;true;true]"),
            ("2 .>= [1,2,3]", "[true,true,false]"),
            ('["a"] .>= "a"', "[true]"),
            ('["a","b"] .+ "c"', "[ac,bc]"),
            ('"a" .+ ["b";"c"]', "[ab;ac]"),
            ('["a","b"] .+ ["c","d"]', "[ac,bd]"),
            ('["a","b"] .+ 1', "[a1,b1]"),
            ('"a" .+ [1,2;3,4]', "[a1,a2;a3,a4]"),
            ('[1;2] .+ ["a";"b"]', "[1a;2b]"),
            ('[true;false] .+ "a"', "[truea;falsea]"),
            ('"a" .+ [true]', "[atrue]"),
            ('["a";"b"] .+ [false;true]', "[afalse;btrue]"),
        ),
    ),
    "func_array": Page(
        _ABC + _TWO + "fibonacci(n) = case n <= 2 : [0:n-1] else : fibonacci([0,1], n)\n"
        "fibonacci(a, n) = case size(a) == n : a\n"
        "  else : fibonacci([a, a[size(a)-2] + a[size(a)-1]], n)\n",
        (
            ('["A", array, "E"]', "[A,B,C,D,E]"),
            ("a", "[-1;-2]"),
            ("b", "[0,1,2;3,3,3]"),
            ("[a, b ; b, a]", "[-1,0,1,2;-2,3,3,3;0,1,2,-1;3,3,3,-2]"),
            ("fibonacci(10)", "[0,1,1,2,3,5,8,13,21,34]"),
        ),
    ),
    "func_index": Page(
        _INDEXED + "indexOfLargest(array) = indexOfLargest(array, 0, 0)\n"
        "indexOfLargest(array, i, iLargest) = case i == size(array) : iLargest\n"
        "  else : case array[i] > array[iLargest] : indexOfLargest(array, i+1, i)\n"
        "         else : indexOfLargest(array, i+1, iLargest)\n"
        'letters = ["_", "d", "i", "a", "g"]\n'
        "zeros(elems) = floatArray[1:elems]\nones(rows,cols) = floatArray[1:rows,1:cols] .+ 1\n"
        "findPrimes(max) = case max <= 1 : floatArray\n"
        "  else : findPrimes(sqrt(max), [2 : max], floatArray)\n"
        "findPrimes(limit, a, primes) =\n"
        "  case a[0] <= limit : findPrimes(limit, a[a .% a[0] .!= 0], [primes, a[0]])\n"
        "  else : [primes, a]\n",
        (
            ("array[0]", "1"),
            ("array[3]", "4"),
            ("table[1, 1]", "5"),
            ("array[[0,2]]", "[1,3]"),
            ("array[[1,1]]", "[2,2]"),
            ("array[3:-1:1]", "[4,3,2]"),
            ("array[[0,1; 2,3]]", "[1,2;3,4]"),
            ("table[1, [0,2]]", "[4,6]"),
            ("table[[0,0,1], 2]", "[3;3;6]"),
            ("table[0:2, [0,2]]", "[1,3;4,6;7,9]"),
            ("array[[true,false,true]]", "[1,3]"),
            ("array[array .> 2]", "[3,4]"),
            ("array[array .> 1 .&& array .<= 3]", "[2,3]"),
            ("table[[false,true,true], 0]", "[4;7]"),
            ("array[-1]", "0"),
            ("array[[false,false,true,true,true]]", "[3,4,0]"),
            ("table[[2,3], -1:1]", "[0,7,8;0,0,0]"),
            ("table[3]", "4"),
            ("table[0 : size(table)-1]", "[1,2,3,4,5,6,7,8,9]"),
            ("table[[0; 3; 6]]", "[1;4;7]"),
            ("table[0, [0,1; 2,3]]", "[1,2,3,0]"),
            ("array[[true,false; true,false]]", "[1,3]"),
            ("indexOfLargest([3,9,4])", "1"),
            (
                "letters[[1,0,0,0; 0,2,0,0; 0,0,3,0; 0,0,0,4]]",
                "[d,_,_,_;_,i,_,_;_,_,a,_;_,_,_,g]",
            ),
            ("zeros(4)", "[0,0,0,0]"),
            ("ones(2,3)", "[1,1,1;1,1,1]"),
            ("findPrimes(20)", "[2,3,5,7,11,13,17,19]"),
        ),
    ),
    "func_colon": Page(
        "steps = [0 : 0.15 : 0.5]\n",
        (
            ("[2 : 4]", "[2,3,4]"),
            ("[0.5 : 3]", "[0.5,1.5,2.5]"),
            ("[4 : 2]", "[]"),
            ("[1 : 0.5 : 3]", "[1,1.5,2,2.5,3]"),
            ("[4 : -1 : 2]", "[4,3,2]"),
            ("[1 : -0.5 : 2]", "[]"),
            ("[1 : -0.5 : 1]", "[1]"),
            ("[1 : 0 : 1]", "[]"),
            ("steps", "[0,0.15,0.3,0.45]"),
            ("steps[3] == 0.45", "false"),
            ("abs(steps[3] - 0.45) < 1e-10", "true"),
        ),
    ),
    "func_findFirst": Page(
        "array1d = [1,2,3,4]\narray2d = [1,2,3;4,5,6]\n",
        (
            ("findFirst(array1d, 2, 0)", "1"),
            ("array1d[findFirst(array1d, 2, 0)]", "2"),
            ("findFirst(array2d, 4, 0)", "3"),
            ("array2d[findFirst(array2d, 4, 0)]", "4"),
            ("findFirst([6,8.1,6,8.1], 8, 0.5)", "1"),
        ),
    ),
    "func_setElems": Page(
        _SET + "enumerate(array, value) with( found := array .== value )\n"
        "  = setElems(floatArray, found, [1:sum(found)])\n"
        "diag(n) = setElems(floatArray[1:n,1:n], [0:n+1:n*n-1], 1)\n"
        "reshape(array, rows, cols) =\n"
        "  setElems(floatArray[1:rows,1:cols], [0:rows*cols-1], array)\n",
        (
            ("setElems(line, 2, 1)", "[0,0,1,0,0,0]"),
            ("setElems(line, [1:4], 1)", "[0,1,1,1,1,0]"),
            ("setElems(line, [1,3,5], [1:3])", "[0,1,0,2,0,3]"),
            ("setElems(line, [5,1,3], [1:3])", "[0,2,0,3,0,1]"),
            ("setElems(line, [1,1,1], [1:3])", "[0,3,0,0,0,0]"),
            ("setElems(square, 1, 1, 5)", "[0,0,0;0,5,0;0,0,0]"),
            ("setElems(square, [0,2], [0:2], 1)", "[1,1,1;0,0,0;1,1,1]"),
            ("setElems(square, [1,2], [0,2], [1,2;3,4])", "[0,0,0;1,0,2;3,0,4]"),
            ("setElems(square, [2,1], [2,0], [1,2;3,4])", "[0,0,0;4,0,3;2,0,1]"),
            ("setElems(square, [1,1], [0,2], [1,2;3,4])", "[0,0,0;3,0,4;0,0,0]"),
            ("setElems(sequence, sequence .> 4, 4)", "[1,2,3,4,4,4,4]"),
            ("setElems(sequence, sequence .> 4, [3,2,1])", "[1,2,3,4,3,2,1]"),
            ("setElems(pair, 3, 5)", "[1,1,0,5]"),
            ("setElems(pair, 2, 2, 5)", "[1,1,0;0,0,0;0,0,5]"),
            ('enumerate(["a","c","b","a","d","a"], "a")', "[1,0,0,2,0,3]"),
            ("diag(3)", "[1,0,0;0,1,0;0,0,1]"),
            ("reshape([1,2,3; 4,5,6], 3, 2)", "[1,2;3,4;5,6]"),
        ),
    ),
    "func_sortIndices": Page(
        'letters = ["c","b","d","a"]\nnumbers = [2,1,3,3,1]\n'
        'rows = ["e","c","d"; "b","a","c"; "d","a","d"]\n'
        "reverse(array) = array[size(array)-1:-1:0]\nsortAsc(array) = array[sortIndices(array)]\n"
        "sortDesc(array) = reverse(sortAsc(array))\nfindMin(array) = sortIndices(array)[0]\n"
        "findMax(array) = sortIndices(array)[size(array)-1]\n"
        "min(array) = array[findMin(array)]\nmax(array) = array[findMax(array)]\n",
        (
            ("sortIndices(letters)", "[3,1,0,2]"),
            ("letters[sortIndices(letters)]", "[a,b,c,d]"),
            ("sortIndices(numbers)", "[1,4,0,2,3]"),
            ("numbers[sortIndices(numbers)]", "[1,1,2,3,3]"),
            ("sortIndices(rows)", "[1,2,0;4,3,5;7,6,8]"),
            ("rows[sortIndices(rows)]", "[c,d,e;a,b,c;a,d,d]"),
            ('sortAsc(["a","c","b"])', "[a,b,c]"),
            ('sortDesc(["a","c","b"])', "[c,b,a]"),
            ("min([1,4,-1,9])", "-1"),
            ("max([1,4,-1,9])", "9"),
        ),
    ),
    "func_sortRowIndices": Page(
        "a = [4,0,1; 2,1,9; 1,3,0; 2,1,0]\nsortRows(a,columnPrecedence) =\n"
        "  a[sortRowIndices(a[0:nRows(a)-1,columnPrecedence]),0:nColumns(a)-1]\n",
        (
            ("sortRowIndices(a)", "[2,3,1,0]"),
            ("a[sortRowIndices(a),0:nColumns(a)-1]", "[1,3,0;2,1,0;2,1,9;4,0,1]"),
            ("sortRows(a,1)", "[4,0,1;2,1,9;2,1,0;1,3,0]"),
            ("sortRows(a,[1,0,2])", "[4,0,1;2,1,0;2,1,9;1,3,0]"),
        ),
    ),
    "func_sum": Page(
        "cumsum(array) = case size(array) < 2 : [ sum(array) ]\n"
        "  else : [ cumsum(array[0:size(array)-2]), sum(array) ]\n",
        (
            ("sum([1,2,3])", "6"),
            ("sum([true,false,true])", "2"),
            ('sum(["a","b","c"])', "abc"),
            ("cumsum([1:5])", "[1,3,6,10,15]"),
            ('cumsum(["a","b","c","d","e"])', "[a,ab,abc,abcd,abcde]"),
            ("cumsum([false,true,true,false,true])", "[0,1,2,2,3]"),
        ),
    ),
    "func_transpose": Page(
        "a = [1,1,1]\nb = [2,2,2]\nc = transpose([a ; b])\nd = [transpose(a) , transpose(b)]\n",
        (
            ('transpose(["a","b"; "c","d"; "e","f"])', "[a,c,e;b,d,f]"),
            ("c", "[1,2;1,2;1,2]"),
            ("c[0 : size(c)-1]", "[1,2,1,2,1,2]"),
            ("d", "[1,2;1,2;1,2]"),
            ("d[0 : size(d)-1]", "[1,2,1,2,1,2]"),
        ),
    ),
    "func_splitString": Page(
        'rows = splitString("a;b\\nc;d\\n", "\\n")\n',
        (
            ('splitString("a.b.c", ".")', "[a,b,c]"),
            ('splitString(".b.", ".")', "[,b,]"),
            ('splitString("a.b\\nc.d", "\\n")', "[a.b,c.d]"),
            ('splitString("a\\\\b\\\\c", "\\\\")', "[a,b,c]"),
            ('splitString("abc", "")', "[,a,b,c,]"),
            ('splitString("a;b;c", "$;")', "[a,b,c]"),
            ('splitString("a.b.c", "$\\\\.")', "[a,b,c]"),
            ('splitString("a\\t\\tb\\tc", "$\\t+")', "[a,b,c]"),
            ('splitString("a b  c", "$\\\\s+")', "[a,b,c]"),
            ('splitString("a$b$c", "$\\\\$")', "[a,b,c]"),
            ('splitString("abc", "$\\\\B")', "[a,b,c]"),
            ('splitString("abacba", "$(?<=a)b(?=a)")', "[a,acba]"),
            ("rows", "[a;b,c;d,]"),
            ('splitString(rows[0], ";")', "[a,b]"),
            ('size(splitString("", ";"))', "1"),
        ),
    ),
}
