(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Meshes joined along a seam [JOIN-1]. Two meshes without ties, one on either side of a vertical line, and a Delaunay
   triangulation of all their points; if no test of the seam was 0, neighbouring triangles of that have different
   circles, too, so that all is as after insertions [TIE-1]. *)
From Coq Require Import Reals Lra Lia Psatz Classical List.
From Dyadel Require Import Plane Distance Cells Legal Orientation Disc Path Fan TiedFace TiedRim Inserted.
Open Scope R_scope.

(* ---- what join.c does ---- *)

(* q is the left candidate at the base a b: above it, no site of the left part P strictly inside of the circle a b q,
   and no site beyond the edge a q on it. *)
Definition left_candidate (p : nat -> point) (P : nat -> Prop) (a b q : nat) : Prop :=
  P q /\ 0 < orient (p a) (p b) (p q) /\ (forall z, P z -> incircle (p a) (p b) (p q) (p z) <= 0) /\
  forall z, P z -> orient (p a) (p q) (p z) < 0 -> incircle (p a) (p b) (p q) (p z) < 0.

(* The same on the right. *)
Definition right_candidate (p : nat -> point) (P : nat -> Prop) (a b q : nat) : Prop :=
  P q /\ 0 < orient (p a) (p b) (p q) /\ (forall z, P z -> incircle (p a) (p b) (p q) (p z) <= 0) /\
  forall z, P z -> 0 < orient (p b) (p q) (p z) -> incircle (p a) (p b) (p q) (p z) < 0.

Definition none_above (p : nat -> point) (P : nat -> Prop) (a b : nat) : Prop :=
  forall z, P z -> orient (p a) (p b) (p z) <= 0.

(* T' is T1, left of a vertical line, and T2, right of it, with new triangles across. Such a triangle a b c was made on
   the base a b by the left candidate c or by the right one; no test was 0: of c against the triangle beyond its edge,
   of c against the other candidate. Nor were those of the two tangents against the next corners of the hull. *)
Definition joined (N : nat) (p : nat -> point) (S1 S2 : nat -> Prop) (T1 T2 T' : mesh) : Prop :=
  (forall a b, S1 a -> S2 b -> fst (p a) < fst (p b)) /\
  (forall a b c, T' a b c -> S1 a \/ a = N -> S1 b \/ b = N -> S1 c \/ c = N -> T1 a b c) /\
  (forall a b c, T' a b c -> S2 a \/ a = N -> S2 b \/ b = N -> S2 c \/ c = N -> T2 a b c) /\
  (forall a b c, T' a b c -> S1 a -> S2 b -> S1 c -> left_candidate p S1 a b c /\
    (forall r, T' a c r -> S1 r -> incircle (p a) (p b) (p c) (p r) <> 0) /\
    (none_above p S2 a b \/ exists q, right_candidate p S2 a b q /\ incircle (p a) (p b) (p c) (p q) <> 0)) /\
  (forall a b c, T' a b c -> S1 a -> S2 b -> S2 c -> right_candidate p S2 a b c /\
    (forall r, T' c b r -> S2 r -> incircle (p a) (p b) (p c) (p r) <> 0) /\
    (none_above p S1 a b \/ exists q, left_candidate p S1 a b q /\ incircle (p a) (p b) (p c) (p q) <> 0)) /\
  (forall a b e, T' b a N -> S1 a -> S2 b ->
    (T' a e N -> S1 e -> orient (p a) (p b) (p e) <> 0) /\ (T' e b N -> S2 e -> orient (p a) (p b) (p e) <> 0)) /\
  (forall a b e, T' a b N -> S1 a -> S2 b ->
    (T' e a N -> S1 e -> orient (p a) (p b) (p e) <> 0) /\ (T' b e N -> S2 e -> orient (p a) (p b) (p e) <> 0)).

(* ---- four points ---- *)

Lemma on_circle o a b c z : 0 < orient a b c -> (forall w, incircle a b c w = - orient a b c * about o a w) ->
  incircle a b c z = 0 -> about o a z = 0.
Proof. intros O F Z. rewrite F in Z. apply Rmult_integral in Z. destruct Z; lra. Qed.

(* On one circle, a b c on the one side and b a d on the other. *)
Lemma beyond a b c d : 0 < orient a b c -> 0 < orient b a d -> incircle a b c d = 0 ->
  0 < orient b c d /\ 0 < orient c a d /\ 0 < orient a d c /\ 0 < orient d b c.
Proof.
  intros O1 O2 Z. destruct (centre_of a b c O1) as [o [A1 [A2 F]]].
  assert (E : about o a d = 0) by now apply (on_circle o a b c d).
  destruct (cap o a b c d A1 A2 O1) as [X Y]; [unfold orient in *; lra | lra |].
  repeat split; unfold orient in *; lra.
Qed.

(* Two of them left of a line and two right of it: not the ends of one diagonal and of the other. *)
Lemma crossed a b c d : 0 < orient a b c -> 0 < orient b a d -> incircle a b c d = 0 ->
  fst a < fst c -> fst a < fst d -> fst b < fst c -> fst b < fst d -> False.
Proof.
  intros O1 O2 Z Ac Ad Bc Bd. destruct (beyond a b c d O1 O2 Z) as [X [Y _]].
  assert (E : orient a b c * fst d = orient b c d * fst a + orient c a d * fst b + orient a b d * fst c)
    by (unfold orient; ring).
  pose proof (orient_sum a b c d) as S. assert (T : orient a b d < 0) by (unfold orient in *; lra).
  set (x := orient b c d) in *. set (y := orient c a d) in *. set (t := orient a b d) in *.
  set (k := orient a b c) in *.
  destruct (Rle_dec (fst c) (fst d)) as [L | L].
  - assert (K : x * (fst c - fst a) + y * (fst c - fst b) + k * (fst d - fst c) = 0) by (rewrite <- S in *; lra).
    assert (0 < x * (fst c - fst a)) by (apply Rmult_lt_0_compat; lra).
    assert (0 < y * (fst c - fst b)) by (apply Rmult_lt_0_compat; lra).
    assert (0 <= k * (fst d - fst c)) by (apply Rmult_le_pos; lra). lra.
  - assert (K : x * (fst d - fst a) + y * (fst d - fst b) + - t * (fst c - fst d) = 0) by (rewrite <- S in *; lra).
    assert (0 < x * (fst d - fst a)) by (apply Rmult_lt_0_compat; lra).
    assert (0 < y * (fst d - fst b)) by (apply Rmult_lt_0_compat; lra).
    assert (0 < - t * (fst c - fst d)) by (apply Rmult_lt_0_compat; lra). lra.
Qed.

Lemma incircle_turn a b c z : incircle b c a z = incircle a b c z.
Proof. unfold incircle, dist2, orient. ring. Qed.

Lemma incircle_other a b c d : incircle b a d c = incircle a b c d.
Proof. unfold incircle, dist2, orient. ring. Qed.

(* Above the base a b: d on the circle of a b c, q outside of it; then d is inside of that of a b q. *)
Lemma candidate_missed a b c q d : 0 < orient a b c -> 0 < orient a b q -> 0 < orient a b d ->
  incircle a b c d = 0 -> incircle a b c q < 0 -> 0 < incircle a b q d.
Proof.
  intros O1 O2 O3 Z L. destruct (centre_of a b c O1) as [o [A1 [A2 F]]].
  destruct (centre_of a b q O2) as [w [B1 [B2 G]]].
  pose proof (on_circle o a b c d O1 F Z) as D. rewrite F in L. rewrite G.
  assert (Nab : a <> b) by (intros ->; unfold orient in O1; lra).
  destruct (pencil o w a b Nab A1 B1) as [l K]. pose proof (K q) as Kq. rewrite K, D. rewrite B2 in Kq.
  assert (0 < about o a q) by nra. assert (l < 0) by nra.
  assert (l * orient a b d < 0) by nra. nra.
Qed.

Lemma flat_triangle a b x y z : a <> b -> orient a b x = 0 -> orient a b y = 0 -> orient a b z = 0 -> orient x y z = 0.
Proof.
  intros D X Y Z. assert (S : 0 < dist2 a b) by (rewrite <- dist_sq; pose proof (dist_pos _ _ D); nra).
  set (k u := (fst u - fst a) * (fst b - fst a) + (snd u - snd a) * (snd b - snd a)).
  assert (E : dist2 a b * orient x y z =
    orient a b x * (k z - k y) + orient a b y * (k x - k z) + orient a b z * (k y - k x))
    by (unfold k, dist2, orient; ring).
  rewrite X, Y, Z in E. apply (Rmult_eq_reg_l (dist2 a b)); lra.
Qed.

(* From v the directions to c and d are the same: a point right of the one is left of the other. *)
Lemma same_way v c d z : 0 < (fst c - fst v) * (fst d - fst v) -> orient c v d = 0 ->
  orient c v z <= 0 -> orient v d z <= 0 -> orient v d z = 0.
Proof.
  intros S E C D. apply Rle_antisym; [exact D |]. apply Rnot_lt_le. intros L.
  assert (K : (fst d - fst v) * (fst d - fst v) * orient c v z = - ((fst c - fst v) * (fst d - fst v)) * orient v d z
    + (fst d - fst v) * (fst z - fst v) * orient c v d) by (unfold orient; ring).
  rewrite E in K. assert (fst d <> fst v) by (intros X; rewrite X in S; nra).
  assert (0 < (fst d - fst v) * (fst d - fst v)) by nra.
  assert (0 < - ((fst c - fst v) * (fst d - fst v)) * orient v d z) by nra. nra.
Qed.

(* ---- the seam ---- *)

Section Seam.
Variables (N : nat) (p : nat -> point) (S1 S2 : nat -> Prop) (T1 T2 T' : mesh).
Variable left : delaunay N p S1 T1.
Variable right : delaunay N p S2 T2.
Variable whole : delaunay N p (fun z => S1 z \/ S2 z) T'.
Variable seam : joined N p S1 S2 T1 T2 T'.

Lemma seam_corner a b c : T' a b c -> (S1 a \/ S2 a \/ a = N) /\ (S1 b \/ S2 b \/ b = N) /\ (S1 c \/ S2 c \/ c = N) /\
  T' b c a /\ T' c a b.
Proof.
  intros F. destruct whole as [R _]. destruct (R _ _ _ F) as [G [_ [A _]]]. destruct (R _ _ _ G) as [H [_ [B _]]].
  destruct (R _ _ _ H) as [_ [_ [C _]]]. tauto.
Qed.

Lemma left_below a : S1 a -> (a < N)%nat.
Proof. apply left. Qed.
Lemma right_below a : S2 a -> (a < N)%nat.
Proof. apply right. Qed.

Lemma not_both a : S1 a -> S2 a -> False.
Proof. intros A B. destruct seam as [L _]. pose proof (L a a A B). lra. Qed.

Lemma real_triangle a b c : T' a b c -> (a < N)%nat -> (b < N)%nat -> (c < N)%nat ->
  0 < orient (p a) (p b) (p c) /\ forall z, S1 z \/ S2 z -> incircle (p a) (p b) (p c) (p z) <= 0.
Proof.
  intros F A B C. destruct whole as [R _]. destruct (R _ _ _ F) as [_ [_ [_ [O W]]]]. split; [now apply O |].
  intros z Z. specialize (W z Z). unfold test in W. destruct (Nat.eqb_spec a N); [lia |].
  destruct (Nat.eqb_spec b N); [lia |]. destruct (Nat.eqb_spec c N); [lia | exact W].
Qed.

Lemma ghost_triangle a b : T' a b N -> (a < N)%nat -> (b < N)%nat ->
  forall z, S1 z \/ S2 z -> orient (p a) (p b) (p z) <= 0.
Proof.
  intros F A B z Z. destruct whole as [R _]. destruct (R _ _ _ F) as [_ [_ [_ [_ W]]]]. specialize (W z Z).
  unfold test in W. destruct (Nat.eqb_spec a N); [lia |]. destruct (Nat.eqb_spec b N); [lia |].
  now rewrite Nat.eqb_refl in W.
Qed.

(* The edge a b across, with the triangles b a d below and a b c above. *)
Lemma across_untied a b c d : T' a b c -> T' b a d -> S1 a -> S2 b -> S1 c \/ S2 c -> S1 d \/ S2 d ->
  incircle (p a) (p b) (p c) (p d) <> 0.
Proof.
  intros F G A B C D Z. pose proof (left_below a A) as La. pose proof (right_below b B) as Lb.
  assert (Lc : (c < N)%nat) by (destruct C; [now apply left_below | now apply right_below]).
  assert (Ld : (d < N)%nat) by (destruct D; [now apply left_below | now apply right_below]).
  destruct (real_triangle _ _ _ F La Lb Lc) as [O1 _]. destruct (real_triangle _ _ _ G Lb La Ld) as [O2 W].
  destruct (beyond _ _ _ _ O1 O2 Z) as [_ [_ [X Y]]].
  destruct (seam_corner _ _ _ G) as [_ [_ [_ [G1 G2]]]].
  destruct seam as [_ [_ [_ [Le [Ri _]]]]]. rewrite <- incircle_other in Z.
  destruct D as [D | D].
  - (* the base d b, a on the left *)
    rewrite incircle_turn in Z. destruct (real_triangle _ _ _ G2 Ld Lb La) as [O3 W3].
    destruct (Le _ _ _ G2 D B A) as [[_ [Oa [_ Before]]] [_ Other]]. destruct C as [C | C].
    + specialize (Before c C). rewrite Z in Before. assert (orient (p d) (p a) (p c) < 0); [| lra].
      unfold orient in *. lra.
    + destruct Other as [None | [q [[Q [Oq [Empty _]]] T]]]; [specialize (None c C); lra |].
      specialize (W3 q (or_intror Q)). specialize (Empty c C).
      pose proof (candidate_missed _ _ _ _ _ O3 Oq Y Z). lra.
  - (* the base a d, b on the right *)
    rewrite <- incircle_turn in Z. destruct (real_triangle _ _ _ G1 La Ld Lb) as [O3 W3].
    destruct (Ri _ _ _ G1 A D B) as [[_ [Ob [_ Before]]] [_ Other]]. destruct C as [C | C].
    + destruct Other as [None | [q [[Q [Oq [Empty _]]] T]]]; [specialize (None c C); lra |].
      specialize (W3 q (or_introl Q)). specialize (Empty c C).
      pose proof (candidate_missed _ _ _ _ _ O3 Oq X Z). lra.
    + specialize (Before c C). lra.
Qed.

(* Both ends in one part. *)
Lemma along_untied a b c d : untied N p T1 -> untied N p T2 -> T' a b c -> T' b a d -> S1 a /\ S1 b \/ S2 a /\ S2 b ->
  S1 c \/ S2 c -> S1 d \/ S2 d -> incircle (p a) (p b) (p c) (p d) <> 0.
Proof.
  intros U1 U2 F G AB C D Z. pose proof left_below as Lef. pose proof right_below as Rig.
  assert (La : (a < N)%nat) by (destruct AB as [[] | []]; auto).
  assert (Lb : (b < N)%nat) by (destruct AB as [[] | []]; auto).
  assert (Lc : (c < N)%nat) by (destruct C; auto). assert (Ld : (d < N)%nat) by (destruct D; auto).
  destruct (real_triangle _ _ _ F La Lb Lc) as [O1 _]. destruct (real_triangle _ _ _ G Lb La Ld) as [O2 _].
  assert (E : forall T, untied N p T -> T a b c -> T b a d -> False).
  { intros T U K L. specialize (U a b c d K L). unfold test in U. destruct (Nat.eqb_spec a N); [lia |].
    destruct (Nat.eqb_spec b N); [lia |]. destruct (Nat.eqb_spec c N); [lia |]. rewrite Z in U.
    apply (Rlt_irrefl 0), U; lia. }
  destruct (seam_corner _ _ _ F) as [_ [_ [_ [F1 F2]]]]. destruct (seam_corner _ _ _ G) as [_ [_ [_ [G1 G2]]]].
  destruct seam as [Sep [Old1 [Old2 [Le [Ri _]]]]]. pose proof Z as Z'. rewrite <- incircle_other in Z'.
  destruct AB as [[A B] | [A B]]; destruct C as [C | C]; destruct D as [D | D].
  - apply (E T1 U1); [apply Old1 | apply Old1]; auto.
  - (* the base a d, b on the left *)
    destruct (Le _ _ _ G1 A D B) as [_ [T _]]. apply (T c F C). rewrite incircle_turn. exact Z'.
  - (* the base b c, a on the left *)
    destruct (Le _ _ _ F1 B C A) as [_ [T _]]. apply (T d G D). rewrite incircle_turn. exact Z.
  - apply (crossed _ _ _ _ O1 O2 Z); apply Sep; auto.
  - destruct (beyond _ _ _ _ O1 O2 Z) as [X [Y _]].
    apply (crossed (p c) (p d) (p b) (p a)); try (apply Sep; auto); try (unfold orient in *; lra).
    rewrite <- Ropp_0, <- Z. unfold incircle, dist2, orient. ring.
  - (* the base c a, b on the right *)
    destruct (Ri _ _ _ F2 C A B) as [_ [T _]]. apply (T d G D). rewrite 2!incircle_turn. exact Z.
  - (* the base d b, a on the right *)
    destruct (Ri _ _ _ G2 D B A) as [_ [T _]]. apply (T c F C). rewrite 2!incircle_turn. exact Z'.
  - apply (E T2 U2); [apply Old2 | apply Old2]; auto.
Qed.
(* A corner of the hull, between d and c. *)
Lemma corner_untied v c d : untied N p T1 -> untied N p T2 -> T' v N c -> T' N v d -> S1 v \/ S2 v ->
  orient (p c) (p v) (p d) <> 0.
Proof.
  intros U1 U2 F G V Z. pose proof left_below as Lef. pose proof right_below as Rig.
  assert (Lv : (v < N)%nat) by (destruct V; auto).
  assert (Ghost : forall a b, T' a b N -> a <> N /\ b <> N).
  { intros a b K. destruct whole as [R _]. destruct (R _ _ _ K) as [K1 _]. destruct (R _ _ _ K1) as [K2 [X _]].
    destruct (R _ _ _ K2) as [_ [Y _]]. split; congruence. }
  destruct (seam_corner _ _ _ F) as [_ [_ [C [_ F2]]]]. destruct (seam_corner _ _ _ G) as [_ [_ [D [G1 _]]]].
  destruct (Ghost _ _ F2) as [Nc _]. destruct (Ghost _ _ G1) as [_ Nd].
  assert (C' : S1 c \/ S2 c) by (clear - C Nc; tauto). assert (D' : S1 d \/ S2 d) by (clear - D Nd; tauto).
  assert (Lc : (c < N)%nat) by (destruct C'; auto). assert (Ld : (d < N)%nat) by (destruct D'; auto).
  assert (E : forall T, untied N p T -> T v N c -> T N v d -> False).
  { intros T U K L. specialize (U v N c d K L). unfold test in U. destruct (Nat.eqb_spec v N); [lia |].
    rewrite Nat.eqb_refl, Z in U. apply (Rlt_irrefl 0), U; lia. }
  assert (Same : 0 < (fst (p c) - fst (p v)) * (fst (p d) - fst (p v)) -> False).
  { intros S. assert (Flat : forall z, S1 z \/ S2 z -> orient (p v) (p d) (p z) = 0).
    { intros z Q. apply (same_way (p v) (p c)); auto;
        [now apply (ghost_triangle c v F2) | now apply (ghost_triangle v d G1)]. }
    assert (Nvd : p v <> p d) by (intros X; rewrite X in S; lra).
    destruct whole as [R [_ [_ [[x [y [z [Q [X [Y W]]]]]] _]]]]. destruct (R _ _ _ Q) as [Q1 [_ [Sx [O _]]]].
    destruct (R _ _ _ Q1) as [Q2 [_ [Sy _]]]. destruct (R _ _ _ Q2) as [_ [_ [Sz _]]]. specialize (O X Y W).
    rewrite (flat_triangle (p v) (p d)) in O; [lra | exact Nvd | | |]; apply Flat.
    - destruct Sx; [assumption | lia].
    - destruct Sy; [assumption | lia].
    - destruct Sz; [assumption | lia]. }
  destruct seam as [Sep [Old1 [Old2 [_ [_ [Lower Upper]]]]]].
  assert (Z1 : orient (p v) (p c) (p d) = 0) by (unfold orient in *; lra).
  assert (Z2 : orient (p v) (p d) (p c) = 0) by (unfold orient in *; lra).
  assert (Z3 : orient (p d) (p v) (p c) = 0) by (unfold orient in *; lra).
  destruct V as [V | V]; destruct C' as [C' | C']; destruct D' as [D' | D'].
  - apply (E T1 U1); [apply Old1 | apply Old1]; auto.
  - (* the upper tangent, from d to v *)
    destruct (Upper v d c G1 V D') as [X _]. now apply X.
  - destruct (Lower v c d F2 V C') as [X _]. now apply X.
  - apply Same. pose proof (Sep v c V C'). pose proof (Sep v d V D'). apply Rmult_lt_0_compat; lra.
  - apply Same. pose proof (Sep c v C' V). pose proof (Sep d v D' V). nra.
  - destruct (Upper c v d F2 C' V) as [_ X]. now apply X.
  - destruct (Lower d v c G1 D' V) as [_ X]. now apply X.
  - apply (E T2 U2); [apply Old2 | apply Old2]; auto.
Qed.

Theorem seam_untied : untied N p T1 -> untied N p T2 -> untied N p T'.
Proof.
  intros U1 U2 a b c d F G Cn Dn. pose proof left_below as Lef. pose proof right_below as Rig.
  destruct (seam_corner _ _ _ F) as [A [B [C _]]]. destruct (seam_corner _ _ _ G) as [_ [_ [D _]]].
  assert (C' : S1 c \/ S2 c) by (clear - C Cn; tauto). assert (D' : S1 d \/ S2 d) by (clear - D Dn; tauto).
  destruct whole as [R _]. destruct (R _ _ _ F) as [_ [Dab [_ [_ W]]]]. specialize (W d D').
  assert (test N p a b c d <> 0); [| lra].
  unfold test. destruct (Nat.eqb_spec a N) as [-> | An].
  { intros Z. assert (V : S1 b \/ S2 b) by (destruct B as [| []]; [now left | now right | congruence]).
    apply (corner_untied b d c U1 U2 G F V). unfold orient in *. lra. }
  destruct (Nat.eqb_spec b N) as [-> | Bn]; [apply (corner_untied a c d U1 U2 F G); destruct A as [| []]; tauto |].
  destruct (Nat.eqb_spec c N); [contradiction |].
  destruct A as [A | [A | A]]; destruct B as [B | [B | B]]; try contradiction.
  - apply along_untied; auto.
  - now apply across_untied.
  - rewrite <- incircle_other. now apply across_untied.
  - apply along_untied; auto.
Qed.
End Seam.

(* ---- strips, joined two by two ---- *)

Inductive made (N : nat) (p : nat -> point) : (nat -> Prop) -> mesh -> Prop :=
| made_part S T : built N p S T -> made N p S T
| made_joined S1 S2 T1 T2 T' : made N p S1 T1 -> made N p S2 T2 -> joined N p S1 S2 T1 T2 T' ->
    delaunay N p (fun z => S1 z \/ S2 z) T' -> made N p (fun z => S1 z \/ S2 z) T'.

Lemma made_delaunay N p S T : made N p S T -> delaunay N p S T.
Proof. intros [S' T0 B | S1 S2 T1 T2 T0 _ _ _ D]; [now apply built_delaunay | exact D]. Qed.

Lemma delaunay_same N p (S S' : nat -> Prop) T : (forall z, S z <-> S' z) -> delaunay N p S T -> delaunay N p S' T.
Proof.
  intros E [R [U [C [F B]]]]. split; [| split; [exact U | split; [exact C | split; [exact F |]]]].
  - intros a b c K. destruct (R a b c K) as [K1 [D [A [O W]]]]. split; [exact K1 |]. split; [exact D |].
    split; [destruct A; [left; now apply E | now right] |]. split; [exact O |]. intros z Z. now apply W, E.
  - intros z Z. now apply B, E.
Qed.

Section Strips.
Variables (N : nat) (p : nat -> point).
Variable distinct : forall a b, (a < N)%nat -> (b < N)%nat -> a <> b -> p a <> p b.

Theorem strips_untied S T : made N p S T -> untied N p T.
Proof.
  intros D. induction D as [S T D | S1 S2 T1 T2 T' D1 IH1 D2 IH2 J W]; [now apply (no_zero_untied N p distinct S) |].
  pose proof (made_delaunay _ _ _ _ D1) as M1. pose proof (made_delaunay _ _ _ _ D2) as M2.
  apply (seam_untied N p S1 S2 T1 T2 T' M1 M2 W J IH1 IH2).
Qed.

Variables (S : nat -> Prop) (T : mesh) (B : sites).
Variable all : made N p S T.
Variable everybody : forall z, (z < N)%nat -> S z.
Variable points : forall k, (k < N)%nat -> exact (B k) (p k).

Lemma strips_delaunay : delaunay N p (fun z => (z < N)%nat) T.
Proof.
  apply (delaunay_same N p S); [| now apply made_delaunay]. intros z. split; [| apply everybody].
  apply (made_delaunay _ _ _ _ all).
Qed.

Theorem strips_legal a b c : T a b c -> (a < N)%nat -> (b < N)%nat -> legal N B a b.
Proof. apply (untied_legal N p T B distinct strips_delaunay (strips_untied _ _ all) points). Qed.

Theorem strips_corner v c d : T v N c -> T N v d -> sure_hull N B v /\ orient (p c) (p v) (p d) <> 0.
Proof. apply (untied_corner N p T B distinct strips_delaunay (strips_untied _ _ all) points). Qed.
End Strips.

(* ---- the candidates ---- *)

(* u, v, z on the left of x y: if u is inside of the circle x y v and z is not, z is outside of the circle x y u. *)
Lemma chord x y u v z : 0 < orient x y u -> 0 < orient x y v -> 0 < orient x y z -> 0 < incircle x y v u ->
  incircle x y v z <= 0 -> incircle x y u z < 0.
Proof.
  intros U V Z I O. destruct (centre_of x y u U) as [o [A1 [A2 F]]]. destruct (centre_of x y v V) as [w [B1 [B2 G]]].
  assert (D : x <> y) by (intros ->; unfold orient in U; lra).
  destruct (pencil o w x y D A1 B1) as [l K]. rewrite G in I, O. rewrite F. pose proof (K u) as Ku. rewrite A2 in Ku.
  pose proof (K z) as Kz. assert (about w x u < 0) by nra. assert (l < 0) by nra.
  assert (0 <= about w x z) by nra. assert (l * orient x y z < 0) by nra. nra.
Qed.

(* The same for z and r on the other side. *)
Lemma chord_beyond x y u r z : 0 < orient x y u -> 0 < orient y x r -> 0 <= orient y x z -> incircle x y u r <= 0 ->
  incircle y x r z <= 0 -> incircle x y u z <= 0.
Proof.
  intros U V Z I O. destruct (centre_of x y u U) as [o [A1 [A2 F]]]. destruct (centre_of y x r V) as [w [B1 [B2 G]]].
  assert (D : y <> x) by (intros ->; unfold orient in U; lra).
  assert (P : forall t, about o y t = about o x t) by (intros t; unfold about in *; lra).
  assert (A3 : about o y x = 0) by (rewrite P; unfold about; lra).
  destruct (pencil w o y x D B1 A3) as [l K]. rewrite G in O. rewrite F in I |- *. rewrite <- P in I |- *.
  pose proof (K r) as Kr. rewrite B2 in Kr. pose proof (K z) as Kz. assert (0 <= about o y r) by nra.
  assert (0 <= l) by nra.
  assert (0 <= about w y z) by nra. assert (0 <= l * orient y x z) by nra. nra.
Qed.

Section Candidate.
Variables (N : nat) (p : nat -> point) (P : nat -> Prop) (T : mesh).
Variable part : delaunay N p P T.

Lemma part_corner a b c : T a b c -> (a <> N -> P a) /\ a <> b /\
  (a <> N -> b <> N -> c <> N -> 0 < orient (p a) (p b) (p c) /\
    forall z, P z -> incircle (p a) (p b) (p c) (p z) <= 0) /\
  (a <> N -> b <> N -> c = N -> forall z, P z -> orient (p a) (p b) (p z) <= 0).
Proof.
  intros F. destruct part as [R [_ [_ [_ Below]]]]. destruct (R _ _ _ F) as [G [D [A [O W]]]].
  destruct (R _ _ _ G) as [H [_ [B _]]]. destruct (R _ _ _ H) as [_ [_ [C _]]].
  assert (L : forall x, P x \/ x = N -> x <> N -> (x < N)%nat)
    by (intros x [X | X] Y; [now apply Below | contradiction]).
  split; [tauto |]. split; [exact D |]. split; intros Na Nb Nc.
  - split; [apply O; auto |]. intros z Z. specialize (W z Z). unfold test in W.
    destruct (Nat.eqb_spec a N); [contradiction |].
    destruct (Nat.eqb_spec b N); [contradiction |]. destruct (Nat.eqb_spec c N); [contradiction | exact W].
  - intros z Z. specialize (W z Z). unfold test in W. destruct (Nat.eqb_spec a N); [contradiction |].
    destruct (Nat.eqb_spec b N); [contradiction |]. subst c. now rewrite Nat.eqb_refl in W.
Qed.

(* The edge from x to y, of the hull of the part or laid open by taking a triangle away that has u strictly inside of
   its circle; u is beyond it, and the corner r of the triangle that stays is not strictly inside of the circle through
   u. *)
Lemma edge_found x y u r : x <> N -> y <> N -> r <> N -> 0 < orient (p y) (p x) u -> T x y r ->
  incircle (p y) (p x) u (p r) <= 0 ->
  T y x N \/ (exists w, w <> N /\ T y x w /\ 0 < incircle (p y) (p x) (p w) u) ->
  (forall z, P z -> incircle (p y) (p x) u (p z) <= 0) /\
  forall z, P z -> 0 < orient (p y) (p x) (p z) -> incircle (p y) (p x) u (p z) < 0.
Proof.
  intros Nx Ny Nr U F Out First. destruct (part_corner _ _ _ F) as [_ [_ [In _]]]. destruct (In Nx Ny Nr) as [Or Er].
  assert (Beyond : forall z, P z -> 0 < orient (p y) (p x) (p z) -> incircle (p y) (p x) u (p z) < 0).
  { intros z Z O. destruct First as [G | [w [Nw [G I]]]]; destruct (part_corner _ _ _ G) as [_ [_ [A B]]].
    - specialize (B Ny Nx eq_refl z Z). lra.
    - destruct (A Ny Nx Nw) as [Ow Ew]. apply (chord _ _ _ (p w)); auto. }
  split; [| exact Beyond]. intros z Z.
  destruct (Rlt_dec 0 (orient (p y) (p x) (p z))) as [L | L]; [left; now apply Beyond |].
  apply (chord_beyond _ _ _ (p r)); auto. unfold orient in *. lra.
Qed.

Theorem left_candidate_found a b q r : a <> N -> q <> N -> r <> N -> 0 < orient (p a) (p b) (p q) -> T a q r ->
  incircle (p a) (p b) (p q) (p r) <= 0 ->
  T q a N \/ (exists w, w <> N /\ T q a w /\ 0 < incircle (p q) (p a) (p w) (p b)) -> left_candidate p P a b q.
Proof.
  intros Na Nq Nr O F Out First.
  destruct (edge_found a q (p b) r) as [X Y]; auto.
  - unfold orient in *. lra.
  - rewrite <- incircle_turn. exact Out.
  - split; [| split; [exact O | split]].
    + destruct part as [R _]. destruct (R _ _ _ F) as [G _]. destruct (part_corner _ _ _ G). tauto.
    + intros z Z. rewrite incircle_turn. now apply X.
    + intros z Z L. rewrite incircle_turn. apply Y; [exact Z | unfold orient in *; lra].
Qed.

Theorem right_candidate_found a b q r : b <> N -> q <> N -> r <> N -> 0 < orient (p a) (p b) (p q) -> T q b r ->
  incircle (p a) (p b) (p q) (p r) <= 0 ->
  T b q N \/ (exists w, w <> N /\ T b q w /\ 0 < incircle (p b) (p q) (p w) (p a)) -> right_candidate p P a b q.
Proof.
  intros Nb Nq Nr O F Out First. destruct (edge_found q b (p a) r) as [X Y]; auto.
  - unfold orient in *. lra.
  - now rewrite incircle_turn.
  - split; [| split; [exact O | split]].
    + destruct (part_corner _ _ _ F). tauto.
    + intros z Z. rewrite <- incircle_turn. now apply X.
    + intros z Z L. rewrite <- incircle_turn. now apply Y.
Qed.
End Candidate.

(* A triangle is taken away because the other end of the base is inside of its circle; *)
Theorem taken_away_holds a b q r : incircle a q r b = incircle a b q r.
Proof. unfold incircle, dist2, orient. ring. Qed.

(* and so is the next end, when the base moves on by an empty triangle a b b' or a' b a. *)
Theorem base_moves_right a b b' q w : 0 < orient a b q -> 0 < orient a b' q -> 0 < orient q a w ->
  0 < incircle q a w b -> incircle a b b' q <= 0 -> 0 < incircle q a w b'.
Proof.
  intros O O' W I E. apply Rnot_le_lt. intros L.
  assert (incircle q a b b' < 0); [apply (chord _ _ _ w); auto; unfold orient in *; lra |].
  assert (incircle q a b b' = - incircle a b b' q) by (unfold incircle, dist2, orient; ring). lra.
Qed.

Theorem base_moves_left a a' b q w : 0 < orient a b q -> 0 < orient a' b q -> 0 < orient b q w ->
  0 < incircle b q w a -> incircle a b a' q <= 0 -> 0 < incircle b q w a'.
Proof.
  intros O O' W I E. apply Rnot_le_lt. intros L.
  assert (incircle b q a a' < 0); [apply (chord _ _ _ w); auto; unfold orient in *; lra |].
  assert (incircle b q a a' = - incircle a b a' q) by (unfold incircle, dist2, orient; ring). lra.
Qed.
