// RDDL, as pyRDDLGym reads it. Labelled alternatives, no actions: compiler/parse walks the tree.
//
// Accepted with --std=rddlc only, and refused later: a 'draw' as an initial value, 'horizon =
// pos-inf', an INT as discount, an exponent in a REAL.
//
// Accepted beyond pyRDDLGym, all harmless: any order of blocks and sections, a ';' after a block,
// empty lists of values, any number of arguments of a distribution (the checker counts them).
grammar RDDL;

text : block* EOF ;

block : domain | instance | nonFluents | policy ;

// ------------------------------------------------------------------------------------- domain

domain : 'domain' ID '{' domainSection* '}' ';'? ;
policy : 'policy' ID '{' policySection* '}' ';'? ;
policySection : 'domain' '=' ID ';' | domainSection ;

domainSection
    : 'requirements' '='? '{' (ID (',' ID)*)? '}' ';'   # requirements
    | 'types' '{' typeDeclaration* '}' ';'              # types
    | 'pvariables' '{' pvariable* '}' ';'               # pvariables
    | CPFS '{' cpf* '}' ';'                             # cpfs
    | 'reward' '=' expr ';'                             # reward
    | CONSTRAINTS '{' condition* '}' ';'                # constraints
    ;

typeDeclaration : ID ':' ('object' | enumeration) ';' ;
enumeration : '{' (ENUM (',' ENUM)*)? '}' ;

pvariable
    : ID ('(' typeName (',' typeName)* ')')? ':'
      '{' FLUENT_KIND ',' typeName (',' attribute)* '}' ';'
    ;
typeName : ID | PRIMITIVE ;
attribute : ('default' | 'level') '=' constant ;

cpf : ID ('(' (VAR (',' VAR)*)? ')')? '=' (randomVector | expr) ';' ;

condition : expr ';' ;

// ----------------------------------------------------------------------------------- instance

instance : 'instance' ID '{' instanceSection* '}' ';'? ;
nonFluents : 'non-fluents' ID '{' nonFluentsSection* '}' ';'? ;

instanceSection
    : nonFluentsSection                                     # sharedSection
    | 'non-fluents' '=' ID ';'                              # nonFluentsName
    | 'init-state' '{' assignment* '}' ';'                  # initState
    | 'max-nondef-actions' '=' limit ';'                    # maxNondefActions
    | 'horizon' '=' (limit ';' | terminateWhen)             # horizon
    | 'discount' '=' (REAL | INT) ';'                       # discount
    ;
limit : INT | 'pos-inf' ;
terminateWhen : 'terminate-when' '(' expr ')' ';'? ;
nonFluentsSection
    : 'domain' '=' ID ';'                                   # domainName
    | 'objects' '{' objectList* '}' ';'                     # objects
    | 'non-fluents' '{' assignment* '}' ';'                 # nonFluentValues
    ;

objectList : ID ':' '{' ID (',' ID)* '}' ';' ;

assignment
    : '~' ID symbols? ';'                                   # unset
    | ID symbols? ('=' (constant | draw))? ';'              # set
    ;
symbols : '(' symbol (',' symbol)* ')' ;
symbol : ID | ENUM ;

constant
    : BOOLEAN                                               # booleanConstant
    | '-'? INT                                              # integerConstant
    | '-'? REAL                                             # realConstant
    | 'pos-inf'                                             # posInf
    | 'neg-inf'                                             # negInf
    | symbol                                                # symbolConstant
    ;

// A random initial value.
draw
    : DISTRIBUTION '(' expr (',' expr)* ')'                 # drawDistribution
    | DISCRETE '(' ID (',' symbol ':' expr)+ ')'            # drawCases
    | DISCRETE binder expr                                  # drawOver
    ;

// -------------------------------------------------------------------------------- expressions

// From the tightest to the loosest. A construct with an open right end takes everything that
// follows, also where it is the right operand of an operator that binds tighter.
expr
    : BOOLEAN                                               # boolean
    | INT                                                   # integer
    | REAL                                                  # real
    | simpleTerm                                            # termExpr
    | '(' expr ')'                                          # group
    | '[' expr ']'                                          # group
    | ID '[' expr (',' expr)* ']'                           # call
    | DISTRIBUTION '(' expr (',' expr)* ')'                 # distribution
    | DISCRETE '(' ID (',' symbol ':' expr)+ ')'            # discreteCases
    | MATRIX '[' 'row' '=' VAR ',' 'col' '=' VAR ']' '[' expr ']'               # matrixFunction
    | '$' ID '[' (slot (',' slot)*)? ']' vectorReferences?                      # external
    | 'switch' '(' expr ')' '{' switchCase (',' switchCase)* '}'                # switch
    | op=('~' | '-' | '+') expr                             # unary
    | expr op=('*' | '/') expr                              # binary
    | expr op=('+' | '-') expr                              # binary
    | expr op=('==' | '~=' | '<' | '<=' | '>' | '>=') expr  # binary
    | expr op=('^' | '&') expr                              # binary
    | expr op='|' expr                                      # binary
    | expr op='=>' expr                                     # binary
    | expr op='<=>' expr                                    # binary
    | 'if' '(' expr ')' 'then' expr 'else' expr             # if
    | (ID | QUANTIFIER | ARGUMENT_OF) binder expr           # aggregation
    | DISCRETE binder expr                                  # discreteOver
    | 'det' '_' '{' typedVariable ',' typedVariable '}' expr                    # determinant
    ;

switchCase : ('case' term | 'default') ':' expr ;

binder : '_' '{' typedVariable (',' typedVariable)* '}' ;
typedVariable : VAR ':' ID ;

// What may stand as an argument of a fluent.
term
    : simpleTerm                                            # plainTerm
    | ARGUMENT_OF binder expr                               # argumentOfTerm
    | DISCRETE binder expr                                  # discreteTerm
    ;
simpleTerm
    : VAR                                                   # variable
    | ENUM                                                  # literal
    | ID ('(' (term (',' term)*)? ')')?                     # reference
    ;

randomVector : RANDOM_VECTOR '[' slot ']' vectorReferences ;
vectorReferences : '(' (vectorReference (',' vectorReference)*)? ')' ;
vectorReference : ID ('(' (slot (',' slot)*)? ')')? ;
slot : VAR | ENUM | '_' ;

// ------------------------------------------------------------------------------------- tokens

COMMENT : '//' ~[\r\n]* -> skip ;
BLANK : [ \t\r\n\f\u000B]+ -> skip ;

SEMICOLON : ';' ;
COLON : ':' ;
COMMA : ',' ;
ASSIGN : '=' ;
UNDERSCORE : '_' ;
DOLLAR : '$' ;
OPEN_ROUND : '(' ;
CLOSE_ROUND : ')' ;
OPEN_SQUARE : '[' ;
CLOSE_SQUARE : ']' ;
OPEN_CURLY : '{' ;
CLOSE_CURLY : '}' ;

EQUIVALENT : '<=>' ;
IMPLIES : '=>' ;
OR : '|' ;
AND : '^' ;
AMPERSAND : '&' ;
EQUAL : '==' ;
NOT_EQUAL : '~=' ;
LESS : '<' ;
LESS_EQUAL : '<=' ;
GREATER : '>' ;
GREATER_EQUAL : '>=' ;
PLUS : '+' ;
MINUS : '-' ;
TIMES : '*' ;
DIVIDE : '/' ;
NOT : '~' ;

DOMAIN : 'domain' ;
NON_FLUENTS : 'non-fluents' ;
INSTANCE : 'instance' ;
POLICY : 'policy' ;
REQUIREMENTS : 'requirements' ;
TYPES : 'types' ;
PVARIABLES : 'pvariables' ;
REWARD : 'reward' ;
OBJECTS : 'objects' ;
INIT_STATE : 'init-state' ;
MAX_NONDEF_ACTIONS : 'max-nondef-actions' ;
HORIZON : 'horizon' ;
DISCOUNT : 'discount' ;
CPFS : 'cpfs' | 'cdfs' ;
CONSTRAINTS
    : 'termination' | 'action-preconditions' | 'state-action-constraints' | 'state-invariants'
    ;
FLUENT_KIND
    : 'non-fluent' | 'state-fluent' | 'action-fluent' | 'interm-fluent' | 'derived-fluent'
    | 'observ-fluent' | 'param-fluent'
    ;
PRIMITIVE : 'bool' | 'int' | 'real' ;
BOOLEAN : 'true' | 'false' ;
QUANTIFIER : 'forall' | 'exists' ;
ARGUMENT_OF : 'argmax' | 'argmin' ;
DISCRETE : 'Discrete' | 'UnnormDiscrete' ;
DISTRIBUTION
    : 'KronDelta' | 'DiracDelta' | 'Uniform' | 'Bernoulli' | 'Normal' | 'Poisson' | 'Exponential'
    | 'Weibull' | 'Gamma' | 'Binomial' | 'NegativeBinomial' | 'Beta' | 'Geometric' | 'Pareto'
    | 'Student' | 'Gumbel' | 'Laplace' | 'Cauchy' | 'Gompertz' | 'ChiSquare' | 'Kumaraswamy'
    ;
RANDOM_VECTOR : 'MultivariateNormal' | 'MultivariateStudent' | 'Dirichlet' | 'Multinomial' ;
MATRIX : 'inverse' | 'pinverse' | 'cholesky' ;
OBJECT : 'object' ;
DEFAULT : 'default' ;
LEVEL : 'level' ;
POS_INF : 'pos-inf' ;
NEG_INF : 'neg-inf' ;
TERMINATE_WHEN : 'terminate-when' ;
IF : 'if' ;
THEN : 'then' ;
ELSE : 'else' ;
SWITCH : 'switch' ;
CASE : 'case' ;
DET : 'det' ;
// Reserved without a meaning.
RESERVED : 'terminal' | 'otherwise' ;

// A '-' inside a word is part of it, a '-' or '_' behind it is not.
ID : [a-zA-Z] ([a-zA-Z0-9_-]* [a-zA-Z0-9])? '\''? ;
VAR : '?' [a-zA-Z0-9_-]* [a-zA-Z0-9] ;
ENUM : '@' [a-zA-Z0-9_-]* [a-zA-Z0-9] ;
INT : [0-9]+ ;
REAL : [0-9]* '.' [0-9]+ ;
// A REAL with --std=rddlc.
EXPONENT_NUMBER : ([0-9]+ | [0-9]* '.' [0-9]+) [eE] [+-]? [0-9]+ ;

// Spellings of other languages. compiler/parse reports them and puts what was meant in their
// place, so the grammar never sees one.
POINT_WITHOUT_DIGITS : [0-9]+ '.' ([eE] [+-]? [0-9]+)? ;
FOREIGN_OPERATOR : '!' | '!=' | '&&' | '||' | '%' | '**' | '<>' | '->' ;
FOREIGN_COMMENT : '/*' .*? ('*/' | EOF) | '#' ~[\r\n]* ;
LONE_PRIME : '\'' ;
ILLEGAL : . ;
